// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gpu_engine.h"

#include "core/scene/reasons.h"
#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

std::shared_ptr<GpuEngine> copyToCard(std::shared_ptr<FramePasses> passes,
                                      const render::ProjectionEngine &engine,
                                      const task::Progress &progress) {
    render::EngineParts parts = engine.parts();
    return std::make_shared<GpuEngine>(
        SpectrumTextures::upload(std::move(passes), std::move(parts.spectra), progress),
        std::move(parts.channelWeights), parts.fieldOfView, std::move(parts.adaptive));
}

GpuEngine::GpuEngine(std::shared_ptr<const SpectrumTextures> textures,
                     std::vector<render::ChannelWeights> channelWeights,
                     const plan::FieldOfView &fieldOfView,
                     std::shared_ptr<const widths::AdaptiveWidths> widths)
    : m_textures(std::move(textures)), m_channelWeights(std::move(channelWeights)),
      m_setup(std::make_shared<render::FrameSetup>(fieldOfView, std::move(widths))) {}

std::shared_ptr<GpuEngine>
GpuEngine::withChannelWeights(std::vector<render::ChannelWeights> channelWeights) const {
    auto engine = std::make_shared<GpuEngine>(*this);
    engine->m_channelWeights = std::move(channelWeights);
    return engine;
}

std::shared_ptr<GpuEngine> GpuEngine::withoutLight() const {
    auto engine = std::make_shared<GpuEngine>(*this);
    engine->m_textures = m_textures->withoutLight();
    return engine;
}

std::shared_ptr<GpuEngine> GpuEngine::withOneWidth() const {
    return std::make_shared<GpuEngine>(m_textures, m_channelWeights, m_setup->fieldOfView());
}

render::EngineParts GpuEngine::parts() const {
    return {m_textures->spectra(), m_channelWeights, m_setup->fieldOfView(),
            m_setup->adaptiveWidths()};
}

task::Reason GpuEngine::description() const {
    return task::because::gpuEngine(m_textures->passes()->device().capabilities().renderer);
}

scene::Camera GpuEngine::periodOf(const scene::Camera &camera,
                                  const scene::ImageDefinition &image) {
    return m_setup->periodOf(m_textures->spectra(), camera, image);
}

picture::ProjectionImage GpuEngine::render(const scene::Camera &camera,
                                           const scene::ImageDefinition &image,
                                           const shading::Shading &shading,
                                           picture::FrameTimes *times) {
    CardTimes onCard;
    const auto picture = renderOnCard(camera, image, shading, &onCard);
    if (times != nullptr)
        *times = {onCard.sliceMs, onCard.transformMs, onCard.widthShares};
    return picture->download();
}

std::shared_ptr<const CardPicture> GpuEngine::renderOnCard(const scene::Camera &camera,
                                                           const scene::ImageDefinition &image,
                                                           const shading::Shading &shading,
                                                           CardTimes *times) {
    const render::FrameInputs inputs = task::orOutOfMemory(task::because::noMemoryForAnImage, [&] {
        return m_setup->inputsFor(m_textures->spectra(), m_channelWeights, camera, image, shading,
                                  widths::onAllThreads);
    });
    if (inputs.isEmpty()) {
        if (times != nullptr)
            *times = {};
        return m_textures->passes()->empty(camera, inputs.pictureChannels());
    }
    const fourier::SpectrumLayout &layout = m_textures->spectra().fields.front()->layout();
    FrameCommand command{.camera = camera, .grid = inputs.grid};
    command.block =
        frameBlock(inputs, image, layout, m_textures->layout(), m_textures->fieldPages());
    if (inputs.widthMap)
        command.tileWidths.assign(inputs.widthMap->widths.begin(), inputs.widthMap->widths.end());
    command.pages = m_textures->pages(inputs.shading.lit);
    command.fieldPages = m_textures->fieldPages();
    command.slabs = m_textures->layout().slabs;
    command.sums = inputs.mixing.sums;
    command.layers = inputs.mixing.imageCount;
    command.channels = inputs.pictureChannels();
    command.width = layout.width();
    command.evenTerms = layout.kernels.front().terms();
    if (inputs.shading.kernels != nullptr)
        command.momentTerms =
            (*inputs.shading.kernels)[std::size_t(layout.width())].front().terms();
    command.shaded = inputs.isShaded;
    command.cued = inputs.shading.cued;
    command.lit = inputs.shading.lit;
    command.colors = inputs.imageColors();
    if (times == nullptr)
        return m_textures->passes()->render(std::move(command), nullptr);
    auto picture = m_textures->passes()->render(std::move(command), times);
    times->widthShares = inputs.widthShares(layout);
    return picture;
}

} // namespace pellucid::gpu
