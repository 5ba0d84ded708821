// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gpu_engine.h"

#include <cmath>

namespace pellucid::gpu {

FetchPlan planFetch(const plan::RenderPlan &plan, double tolerance,
                    const shading::Shading &shading) {
    const FetchPlan exact{Fetch::exact, plan.predictedError};
    if (plan.spectrum.width() < 2 || !shading.isPlain()) // one cell is read as it is
        return exact;
    const double predicted = std::hypot(plan.predictedError, plan.filterError);
    return predicted <= tolerance ? FetchPlan{Fetch::trilinear, predicted} : exact;
}

std::shared_ptr<GpuEngine> copyToCard(std::shared_ptr<FramePasses> passes,
                                      const render::ProjectionEngine &engine, Fetch fetch,
                                      const task::Progress &progress) {
    render::EngineParts parts = engine.parts();
    return std::make_shared<GpuEngine>(
        SpectrumTextures::upload(std::move(passes), std::move(parts.spectra), progress),
        std::move(parts.shares), parts.room, fetch);
}

GpuEngine::GpuEngine(std::shared_ptr<const SpectrumTextures> textures,
                     std::vector<render::ChannelShares> shares, const plan::SliceRoom &room,
                     Fetch fetch)
    : m_textures(std::move(textures)), m_shares(std::move(shares)), m_room(room), m_fetch(fetch),
      m_kept(std::make_shared<Kept>()) {}

std::shared_ptr<GpuEngine> GpuEngine::withShares(std::vector<render::ChannelShares> shares) const {
    auto engine = std::make_shared<GpuEngine>(*this);
    engine->m_shares = std::move(shares);
    return engine;
}

std::shared_ptr<GpuEngine> GpuEngine::withoutLight() const {
    auto engine = std::make_shared<GpuEngine>(*this);
    engine->m_textures = m_textures->withoutLight();
    return engine;
}

render::EngineParts GpuEngine::parts() const {
    return {m_textures->spectra(), m_shares, m_room};
}

task::Reason GpuEngine::description() const {
    return task::because::gpuEngine(m_textures->passes()->device().capabilities().renderer);
}

picture::ProjectionImage GpuEngine::render(const scene::Camera &camera,
                                           const scene::ImageDefinition &image,
                                           const shading::Shading &shading,
                                           picture::FrameTimes *times) {
    CardTimes onCard;
    const auto picture = renderOnCard(camera, image, shading, &onCard);
    if (times != nullptr)
        *times = {onCard.sliceMs, onCard.transformMs};
    return picture->download();
}

std::shared_ptr<const CardPicture> GpuEngine::renderOnCard(const scene::Camera &camera,
                                                           const scene::ImageDefinition &image,
                                                           const shading::Shading &shading,
                                                           CardTimes *times) {
    const render::EngineSpectra &spectra = m_textures->spectra();
    const fourier::Spectrum &spectrum = *spectra.fields.front();
    const fourier::SpectrumLayout &layout = spectrum.layout();
    const glm::dmat3 axes = camera.axes();
    shading::Shading shone = shading;
    if (!m_textures->takesLight())
        shone.lights.clear();
    const auto sliceShading = shading::sliceShading(shone, axes, spectra.scale);
    const render::Mixing mixing(spectra, m_shares, sliceShading, shone.isGrey());
    const int channels = mixing.grey ? 1 : 3;
    if (mixing.sources.empty()) { // nothing is shown
        if (times != nullptr)
            *times = {};
        return m_textures->passes()->empty(camera, channels);
    }
    FrameCommand command{.camera = camera,
                         .grid = m_kept->framed.gridFor(camera, m_room, spectrum.lattice(), image)};
    const render::FrameGeometry geometry(camera, command.grid, spectrum);
    render::FrameShading shades = render::frameShading(
        sliceShading, mixing, spectrum, geometry.toWrap, axes[2], spectra.scale.stepMm);
    if (shades.cued) {
        auto &moments = m_kept->moments;
        if (!moments)
            moments.emplace(render::momentKernels(layout));
        shades.kernels = &*moments;
        command.momentTerms = moments->front().terms();
    }
    command.shaded = !sliceShading.isPlain();
    command.cued = shades.cued;
    command.lit = shades.lit;
    command.block =
        frameBlock(command.grid, image, geometry, mixing, command.shaded ? &shades : nullptr,
                   layout, m_textures->layout(), m_textures->fieldPages());
    command.pages = m_textures->pages(shades.lit);
    command.fieldPages = m_textures->fieldPages();
    command.slabs = m_textures->layout().slabs;
    command.sums = mixing.sums;
    command.layers = mixing.channels;
    command.channels = channels;
    command.width = layout.width();
    command.evenTerms = layout.kernels.front().terms();
    command.fetch = command.shaded ? Fetch::exact : m_fetch;
    // A single colour is given to the picture; three images have theirs.
    if (!mixing.grey && mixing.channels == 1)
        command.color = {float(mixing.color[0]), float(mixing.color[1]), float(mixing.color[2])};
    return m_textures->passes()->render(std::move(command), times);
}

} // namespace pellucid::gpu
