// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/spectrum_slice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/render/reasons.h"
#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::render {

namespace {

struct WeightedSpectrum {
    const fourier::Spectrum *spectrum;
    double weight;
};

std::vector<WeightedSpectrum> weightedSpectra(const EngineParts &engine) {
    std::vector<WeightedSpectrum> result;
    for (std::size_t n = 0; n < engine.spectra.fields.size(); ++n) {
        const ChannelWeights &share = engine.channelWeights[n];
        const double weight = (share[0] + share[1] + share[2]) / 3.0;
        if (weight != 0.0)
            result.push_back({engine.spectra.fields[n].get(), weight});
    }
    return result;
}

// |D| at a grid coordinate.
double magnitude(const std::vector<WeightedSpectrum> &spectra, const glm::dvec3 &at) {
    std::complex<double> sum = 0.0;
    for (const auto &[spectrum, weight] : spectra)
        sum += weight * spectrum->between({at.x, at.y, at.z}, spectrum->layout().kernels);
    return std::abs(sum);
}

float decibelsOf(double ratio) {
    return ratio > 0.0 ? float(std::max(lowestDecibels, 20.0 * std::log10(ratio)))
                       : float(lowestDecibels);
}

} // namespace

SpectrumSlice spectrumSlice(const EngineParts &engine, const scene::Camera &camera, int side,
                            const task::Progress &progress) {
    assert(side >= 2 && engine.channelWeights.size() == engine.spectra.fields.size());
    const std::vector<WeightedSpectrum> spectra = weightedSpectra(engine);
    // The value that a frame uses, without rounding or interpolation.
    double atZero = 0.0;
    for (const auto &[spectrum, weight] : spectra)
        atZero += weight * spectrum->dc();
    if (!(std::abs(atZero) > 0.0))
        throw task::Error(task::ErrorCode::unusable, task::because::nothingVisible);
    const fourier::Spectrum &first = *spectra.front().spectrum;
    const glm::dmat3 axes = camera.axes();
    SpectrumSlice slice{side, 1.0 / (side * camera.pixelMm), 0.5 / camera.pixelMm, {}};
    task::orOutOfMemory(task::because::noMemoryForAnImage,
                        [&] { slice.decibels.resize(std::size_t(side) * std::size_t(side)); });
    // Cells along each axis of the spectrum per column and per row.
    glm::dvec3 across(0.0), down(0.0);
    for (int d = 0; d < 3; ++d) {
        const glm::dvec3 step = first.lattice().step(d);
        const double cells = first.layout().padded[d] * slice.stepPerMm;
        across[d] = cells * glm::dot(step, axes[0]);
        down[d] = -cells * glm::dot(step, axes[1]);
    }
    const int zero = side / 2;
    const auto sample = [&](int row, int column) -> float & {
        return slice.decibels[std::size_t(row) * std::size_t(side) + std::size_t(column)];
    };
    const auto computed = [&](int row, int column) {
        return decibelsOf(
            magnitude(spectra, double(column - zero) * across + double(row - zero) * down) /
            std::abs(atZero));
    };
    tbb::parallel_for(0, zero + 1, [&](int row) {
        progress.check();
        for (int column = 0; column < side; ++column)
            sample(row, column) = computed(row, column);
    });
    sample(zero, zero) = 0.0F;
    // |D(-s)| = |D(s)| for real fields. An even side has a first column without a counterpart.
    for (int row = zero + 1; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const int mirrored = 2 * zero - column;
            sample(row, column) =
                mirrored < side ? sample(2 * zero - row, mirrored) : computed(row, column);
        }
    return slice;
}

std::vector<std::uint8_t> greyLevels(const SpectrumSlice &slice) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * slice.decibels.size());
    for (const float decibels : slice.decibels) {
        const double share = std::clamp(1.0 - double(decibels) / blackDecibels, 0.0, 1.0);
        const auto grey = std::uint8_t(std::lround(255.0 * share));
        rgba.insert(rgba.end(), {grey, grey, grey, 255});
    }
    return rgba;
}

} // namespace pellucid::render
