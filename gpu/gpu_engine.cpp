// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gpu_engine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::gpu {

namespace {

// Whether no tap is ever negative.
bool canPair(const fourier::Kernel &kernel) {
    constexpr int steps = 256;
    constexpr double rounding = 1e-7;
    for (int n = 0; n <= steps; ++n) {
        const double c = double(n) / steps - 0.5;
        for (int k = 0; k < kernel.width(); ++k)
            if (kernel.value(c + k - 0.5 * (kernel.width() - 1)) < -rounding)
                return false;
    }
    return true;
}

// What the coarse weights leave along one axis, relative to a weight's rounding: the mean over
// offsets of the squares of the pairs' sums, against the square of all taps'; times the mean square
// of the difference of neighbouring cells.
double pairNoise(const fourier::Kernel &kernel, double padding) {
    constexpr int steps = 64;
    double squares = 0.0;
    for (int n = 0; n < steps; ++n) {
        const double c = (n + 0.5) / steps - 0.5, middle = 0.5 * (kernel.width() - 1);
        for (int k = 0; k + 1 < kernel.width(); k += 2) {
            const double sum = kernel.value(c + k - middle) + kernel.value(c + k + 1 - middle);
            squares += sum * sum / steps;
        }
    }
    // De-apodised cells: the field at x has h(x) less than its share of every cell.
    constexpr int places = 64;
    double noise = 0.0;
    for (int n = 0; n < places; ++n) {
        const double x = (n + 0.5) / places * 0.5 / padding;
        const double sine = 2.0 * std::sin(std::numbers::pi * x);
        const double h = kernel.apodisation(x);
        noise += sine * sine / (h * h) / places;
    }
    return squares * noise;
}

} // namespace

FetchPlan planFetch(const render::RenderPlan &plan, double tolerance,
                    const shading::Shading &shading) {
    const auto &layout = plan.spectrum;
    const FetchPlan exact{Fetch::exact, plan.predictedError};
    if (layout.width() < 2 || !shading.isPlain()) // one cell is read as it is
        return exact;
    const double rounding = std::ldexp(1.0, -8) / std::sqrt(12.0);
    double noise = 0.0;
    for (int d = 0; d < 3; ++d) {
        const fourier::Kernel &kernel = layout.kernels[std::size_t(d)];
        if (!canPair(kernel))
            return exact;
        noise += pairNoise(kernel, double(layout.padded[d]) / layout.box.size()[d]);
    }
    const double predicted = std::hypot(plan.predictedError, rounding * std::sqrt(noise));
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
                     std::vector<render::ChannelShares> shares, const render::SliceRoom &room,
                     Fetch fetch)
    : m_textures(std::move(textures)), m_shares(std::move(shares)), m_room(room), m_fetch(fetch) {}

std::shared_ptr<GpuEngine> GpuEngine::withShares(std::vector<render::ChannelShares> shares) const {
    return std::make_shared<GpuEngine>(m_textures, std::move(shares), m_room, m_fetch);
}

std::shared_ptr<GpuEngine> GpuEngine::withoutLight() const {
    return std::make_shared<GpuEngine>(m_textures->withoutLight(), m_shares, m_room, m_fetch);
}

render::EngineParts GpuEngine::parts() const {
    return {m_textures->spectra(), m_shares, m_room};
}

std::string GpuEngine::description() const {
    return "GPU engine, " + m_textures->passes()->device().capabilities().renderer;
}

render::ProjectionImage GpuEngine::render(const render::Camera &camera,
                                          const render::ImageDefinition &image,
                                          const shading::Shading &shading,
                                          render::FrameTimes *times) {
    CardTimes onCard;
    const auto picture = renderOnCard(camera, image, shading, &onCard);
    if (times != nullptr)
        *times = {onCard.sliceMs, onCard.transformMs};
    return picture->download();
}

std::shared_ptr<const CardPicture> GpuEngine::renderOnCard(const render::Camera &camera,
                                                           const render::ImageDefinition &image,
                                                           const shading::Shading &shading,
                                                           CardTimes *times) {
    using render::FrameKind;
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
                         .grid = m_framed.gridFor(camera, m_room, spectrum.lattice(), image)};
    const render::FrameGeometry geometry(camera, command.grid, spectrum);
    render::FrameShading shades = render::frameShading(
        sliceShading, mixing, spectrum, geometry.toWrap, axes[2], spectra.scale.stepMm);
    if (shades.cued) {
        if (!m_moments)
            m_moments.emplace(render::momentKernels(layout));
        shades.kernels = &*m_moments;
        command.momentTerms = m_moments->front().terms();
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
