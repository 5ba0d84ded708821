// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_inputs.h"

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
    return geometry.cellArea * mixing.unit * (mixing.grey ? mixing.color[0] : 1.0);
}

plan::WidthMap::Shares FrameInputs::widthShares(const scene::Camera &camera,
                                                const fourier::SpectrumLayout &layout) const {
    if (widths)
        return widths->shares(slicePlane(camera, grid, geometry));
    plan::WidthMap::Shares all{};
    all[std::size_t(layout.width())] = 1.0;
    return all;
}

ChannelWeights FrameInputs::tint() const {
    return !mixing.grey && mixing.channels == 1 ? mixing.color : ChannelWeights{1.0, 1.0, 1.0};
}

plan::SlicePlane slicePlane(const scene::Camera &camera, const plan::SliceGrid &grid,
                            const FrameGeometry &geometry) {
    return {grid.columns,
            grid.rows,
            geometry.cellsPerColumn,
            geometry.cellsPerRow,
            1.0 / (grid.columns * camera.pixelMm),
            1.0 / (grid.rows * camera.pixelMm)};
}

FrameInputs FrameSetup::inputsFor(const EngineSpectra &spectra,
                                  const std::vector<ChannelWeights> &channelWeights,
                                  const scene::Camera &camera, const scene::ImageDefinition &image,
                                  const shading::Shading &shading) {
    const fourier::Spectrum &spectrum = *spectra.fields.front();
    const glm::dmat3 axes = camera.axes();
    const shading::Shading active = activeShading(shading, spectra);
    const shading::SliceShading slices = shading::sliceShading(active, axes, spectra.scale);
    FrameInputs inputs{.mixing = Mixing(spectra, channelWeights, slices, active.isGrey())};
    if (inputs.isEmpty())
        return inputs;
    inputs.grid = m_framed.gridFor(camera, m_fieldOfView, spectrum.lattice(), image);
    inputs.geometry = FrameGeometry(camera, inputs.grid, spectrum);
    inputs.shading = frameShading(slices, inputs.mixing, spectrum, inputs.geometry.toWrap, axes[2],
                                  spectra.scale.stepMm);
    inputs.isShaded = !slices.isPlain();
    if (inputs.shading.cued) {
        if (!m_moments)
            m_moments.emplace(momentKernels(spectrum.layout()));
        inputs.shading.kernels = &*m_moments;
    }
    // Cue and light change what frequencies are worth.
    if (m_widths && !inputs.isShaded) {
        inputs.widths = m_widths->mapFor(axes, slicePlane(camera, inputs.grid, inputs.geometry),
                                         channelWeights);
        inputs.kernels = m_widths->kernels();
    }
    inputs.zero = zeroSums(inputs.mixing, inputs.shading, spectrum.layout());
    return inputs;
}

} // namespace pellucid::render
