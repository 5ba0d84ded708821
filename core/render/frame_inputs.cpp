// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_inputs.h"

#include <algorithm>
#include <cmath>

#include "core/render/slice_reader.h"

namespace pellucid::render {

namespace {

// Lights need gradients, which exist only if they were prepared.
shading::Shading activeShading(const shading::Shading &shading, const EngineSpectra &spectra) {
    shading::Shading active = shading;
    if (spectra.gradients.empty())
        active.lights.clear();
    return active;
}

// The largest factor of a linear cue within the box; it is linear in the distance from the wrap
// voxel. It bounds the energy of a neighbourhood of the cued slice, not of single frequencies, but
// the energies are those of the brightest cells of blocks.
double largestCue(const FrameShading &shading, const fourier::SpectrumLayout &layout) {
    double largest = std::abs(double(shading.base));
    for (int d = 0; shading.cued && d < 3; ++d)
        largest += std::abs(shading.perMoment[std::size_t(d)]) * 0.5 * layout.box.size()[d] /
                   layout.padded[d];
    return largest;
}

// The sources of a shaded slice, each at the offset of every term; see FrameShading.
std::vector<plan::SliceSource> sliceSources(const FrameInputs &inputs,
                                            const fourier::SpectrumLayout &layout) {
    const Mixing &mixing = inputs.mixing;
    const double cue = largestCue(inputs.shading, layout);
    std::vector<plan::SliceSource> sources;
    for (const FrameSource &from : mixing.sources)
        for (int t = 0; t < inputs.shading.termCount; ++t) {
            const FrameShading::Term &term = inputs.shading.terms[std::size_t(t)];
            plan::SliceSource source{.field = from.field,
                                     .isGradient = from.kind == FrameKind::gradient,
                                     .offset = term.cells};
            for (std::size_t image = 0; image < std::size_t(mixing.imageCount); ++image) {
                const FrameShading::Image &shade = inputs.shading.images[image];
                const double share = from.weights[mixing.sums > 1 ? image : 0];
                ChannelWeights color = mixing.imageColor(image);
                // A single image needs one channel, with the amplitudes of all three.
                if (mixing.imageCount == 1)
                    color = {std::hypot(color[0], color[1], color[2]), 0.0, 0.0};
                for (std::size_t c = 0; c < color.size(); ++c) {
                    const double weight =
                        std::abs(double(std::abs(term.weight)) * color[c] * share);
                    source.amplitude[c] +=
                        weight * cue *
                        std::abs(double(source.isGradient ? shade.magnitude : shade.ambient));
                    for (std::size_t d = 0; d < 3 && !source.isGradient; ++d) {
                        source.amplitude[c] += weight * std::abs(shade.excess[d]);
                        source.perSine[c][d] += weight * cue * std::abs(shade.gradient[d]);
                    }
                }
            }
            sources.push_back(source);
        }
    return sources;
}

// The energy of the picture's frequencies next to 0, less a margin: the whole picture has more.
double lowEnergy(const FrameInputs &inputs, const EngineSpectra &spectra,
                 const plan::SlicePlane &plane) {
    constexpr double maxCells = 4.0, margin = 0.8;
    const SliceReader reader(spectra, inputs.mixing, inputs.shading,
                             SliceReader::Rounding::unknown);
    const auto longest = [](const std::array<double, 3> &step) {
        return std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    };
    // A slice is smooth from cell to cell; a fine one need not be read everywhere.
    const int stepColumns = std::max(1, int(1.0 / longest(plane.perColumn))),
              stepRows = std::max(1, int(1.0 / longest(plane.perRow)));
    const auto countOf = [&](const std::array<double, 3> &step, int each, int count) {
        return std::min(count / 2 - 1, int(maxCells / longest(step))) / each;
    };
    const int columns = countOf(plane.perColumn, stepColumns, plane.columns),
              rows = countOf(plane.perRow, stepRows, plane.rows);
    double energy = 0.0;
    for (int row = -rows; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            std::array<double, 3> cells{};
            for (std::size_t d = 0; d < 3; ++d)
                cells[d] =
                    column * stepColumns * plane.perColumn[d] + row * stepRows * plane.perRow[d];
            if (longest(cells) > maxCells)
                continue;
            // The other half of the plane mirrors this one.
            for (const SliceReader::Read &channel : reader.at(cells))
                energy += (column > 0 ? 2.0 : 1.0) * std::norm(channel.value);
        }
    return margin * energy * stepColumns * stepRows * plane.columnPerMm * plane.rowPerMm;
}

} // namespace

double FrameInputs::unit() const {
    return geometry.cellArea * mixing.unit * (mixing.grey ? mixing.imageColor(0)[0] : 1.0);
}

plan::WidthMap::Shares FrameInputs::widthShares(const scene::Camera &camera,
                                                const fourier::SpectrumLayout &layout) const {
    if (widths)
        return widths->shares(slicePlane(camera, grid, geometry));
    plan::WidthMap::Shares all{};
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
                                  const shading::Shading &shading, const plan::ForEach &forEach) {
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
    if (inputs.shading.cued) {
        if (!m_moments)
            m_moments.emplace(momentKernels(spectrum.layout()));
        inputs.shading.kernels = &*m_moments;
    }
    if (m_widths && m_widths->image() == image &&
        (!inputs.shading.lit || m_widths->hasGradients())) {
        const plan::SlicePlane plane = slicePlane(camera, inputs.grid, inputs.geometry);
        // The moments of a linear cue have kernels of one width.
        using Reduction = plan::AdaptiveWidths::Reduction;
        inputs.widths = inputs.isShaded
                            ? m_widths->mapFor(plane, sliceSources(inputs, spectrum.layout()),
                                               lowEnergy(inputs, spectra, plane),
                                               inputs.shading.cued ? Reduction::skippingOnly
                                                                   : Reduction::narrowerKernels,
                                               forEach)
                            : m_widths->mapFor(axes, plane, channelWeights, forEach);
        inputs.kernels = m_widths->kernels();
    }
    inputs.zero = zeroSums(inputs.mixing, inputs.shading, spectrum.layout());
    return inputs;
}

} // namespace pellucid::render
