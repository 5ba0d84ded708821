// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_inputs.h"

#include <algorithm>
#include <cmath>

namespace pellucid::render {

namespace {

// Lights need gradients, which exist only if they were prepared.
shading::Shading activeShading(const shading::Shading &shading, const EngineSpectra &spectra) {
    shading::Shading active = shading;
    if (spectra.gradients.empty())
        active.lights.clear();
    return active;
}

} // namespace

double FrameInputs::unit() const {
    return geometry.cellArea * mixing.unit * (mixing.grey ? mixing.imageColor(0)[0] : 1.0);
}

widths::WidthMap::Shares FrameInputs::widthShares(const fourier::SpectrumLayout &layout) const {
    if (widthMap)
        return widthMap->shares(plane());
    widths::WidthMap::Shares all{};
    all[std::size_t(layout.width())] = 1.0;
    return all;
}

FrameInputs::ImageColors FrameInputs::imageColors() const {
    ImageColors colors{};
    for (std::size_t image = 0; image < std::size_t(mixing.imageCount); ++image)
        for (std::size_t c = 0; c < 3; ++c)
            colors[image][c] = float(mixing.grey ? 1.0 : mixing.imageColor(image)[c]);
    return colors;
}

FrameJob readingJob(const FrameInputs &inputs, const fourier::Spectrum &spectrum,
                    const scene::ImageDefinition &image) {
    const Mixing &mixing = inputs.mixing;
    FrameJob job;
    job.layout = &spectrum.layout();
    job.cellLayout = &spectrum.cellLayout();
    job.sources = mixing.sources.data();
    job.sourceCount = int(mixing.sources.size());
    job.imageCount = mixing.imageCount;
    job.sums = mixing.sums;
    job.shading = inputs.isShaded ? &inputs.shading : nullptr;
    job.image = image;
    job.columns = inputs.grid.columns;
    job.rows = inputs.grid.rows;
    job.cellsPerColumn = inputs.geometry.cellsPerColumn;
    job.cellsPerRow = inputs.geometry.cellsPerRow;
    job.edgeSlack = inputs.geometry.edgeSlack;
    for (int width = fourier::KernelsByWidth::narrowest;
         inputs.kernels && width < spectrum.layout().width(); ++width)
        job.kernels[std::size_t(width)] = inputs.kernels->of(width).data();
    job.kernels[std::size_t(spectrum.layout().width())] = spectrum.layout().kernels.data();
    job.zero = inputs.zero;
    return job;
}

FrameInputs FrameSetup::inputsFor(const EngineSpectra &spectra,
                                  const std::vector<ChannelWeights> &channelWeights,
                                  const scene::Camera &camera, const scene::ImageDefinition &image,
                                  const shading::Shading &shading, const widths::ForEach &forEach) {
    const fourier::Spectrum &spectrum = *spectra.fields.front();
    const glm::dmat3 axes = camera.axes();
    const shading::Shading active = activeShading(shading, spectra);
    const shading::SliceShading slices = shading::sliceShading(active, axes, spectra.scale);
    FrameInputs inputs{.mixing = Mixing(spectra, channelWeights, slices, active.isGrey())};
    if (inputs.isEmpty())
        return inputs;
    inputs.grid = m_framed.gridFor(camera, m_fieldOfView, spectrum.lattice(), image);
    inputs.geometry = FrameGeometry(camera, inputs.grid, spectrum);
    inputs.radial = RadialFactors(image, camera.pixelMm);
    inputs.shading = frameShading(slices, inputs.mixing, spectrum, inputs.geometry.toWrap, axes[2],
                                  spectra.scale.stepMm);
    inputs.isShaded = !slices.isPlain();
    inputs.zero = zeroSums(inputs.mixing, inputs.shading, spectrum.layout());
    if (m_adaptive && (!inputs.shading.lit || !m_adaptive->gradients.empty()))
        inputs.kernels = m_adaptive->kernels;
    if (inputs.shading.cued)
        inputs.shading.kernels = momentsFor(inputs.kernels.get(), spectrum.layout());
    if (inputs.kernels)
        inputs.widthMap = m_frameWidths.choose(*m_adaptive, inputs, spectrum, image, forEach);
    return inputs;
}

const MomentKernels *FrameSetup::momentsFor(const fourier::KernelsByWidth *narrower,
                                            const fourier::SpectrumLayout &layout) {
    const auto make = [&](int width, const std::array<fourier::Kernel, 3> &kernels) {
        auto &moments = m_moments[std::size_t(width)];
        if (moments.empty())
            moments = momentKernels(kernels, layout);
    };
    for (int width = fourier::KernelsByWidth::narrowest;
         narrower != nullptr && width < layout.width(); ++width)
        make(width, narrower->of(width));
    make(layout.width(), layout.kernels);
    return &m_moments;
}

} // namespace pellucid::render
