// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/sheared_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/fourier/transforms/padded_size.h"

namespace pellucid::plan {

namespace {

// A whole number of cells is only this close to one, because of rounding.
constexpr double cellRounding = 1e-9;

ShearedAxis shearedAxis(const volume::Lattice &lattice, const volume::VoxelBox &box, int axis,
                        int along, double shear, double band) {
    const auto fromMiddle = [&](int d, int n) { return n - 0.5 * (lattice.size()[d] - 1); };
    const std::array<int, 3> lo{box.lo.i, box.lo.j, box.lo.k}, hi{box.hi.i, box.hi.j, box.hi.k};
    const auto d = std::size_t(axis), s = std::size_t(along);
    const double atLow = -shear * fromMiddle(along, lo[s]),
                 atHigh = -shear * fromMiddle(along, hi[s] - 1);
    ShearedAxis result{.axis = axis, .shear = shear, .band = band};
    // Shorter shifts change no phase by more than the rounding of a float.
    result.isSpread =
        2.0 * std::numbers::pi * band * std::max(std::abs(atLow), std::abs(atHigh)) > 0x1p-24;
    if (result.isSpread)
        result.cellsPerSample =
            std::max(1, int(std::ceil(2.0 * spreadPadding * band - cellRounding)));
    else
        result.shear = 0.0;
    const int tapMargin = result.isSpread ? spreadKernel().width() / 2 + 1 : 0;
    const double from = fromMiddle(axis, lo[d]) + (result.isSpread ? std::min(atLow, atHigh) : 0.0),
                 to = fromMiddle(axis, hi[d] - 1) +
                      (result.isSpread ? std::max(atLow, atHigh) : 0.0);
    result.cells =
        int(std::ceil(result.cellsPerSample * (to - from) - cellRounding)) + 1 + 2 * tapMargin;
    result.first = from - double(tapMargin) / result.cellsPerSample;
    result.padded = fourier::paddedSize(result.cells, readPadding);
    return result;
}

} // namespace

int ShearedAxis::reach() const {
    return int(std::ceil(std::min(band * cellsPerCycle(), 0.5 * padded)));
}

const fourier::Kernel &spreadKernel() {
    static const fourier::Kernel kernel =
        fourier::Kernel::kaiserBessel(fourier::Kernel::largestWidth, spreadPadding);
    return kernel;
}

const fourier::Kernel &readKernel() {
    static const fourier::Kernel kernel =
        fourier::Kernel::kaiserBessel(fourier::Kernel::largestWidth, readPadding);
    return kernel;
}

ShearedGrid::ShearedGrid(const volume::Lattice &lattice, const volume::VoxelBox &box,
                         const glm::dvec3 &toViewer, double pixelMm,
                         const scene::ImageDefinition &image) {
    const glm::dmat3 steps(lattice.step(0), lattice.step(1), lattice.step(2));
    const glm::dvec3 view = glm::inverse(steps) * toViewer; // in samples
    for (int d = 1; d < 3; ++d)
        if (std::abs(view[d]) > std::abs(view[along]))
            along = d;
    const auto bandOf = [&](int d) {
        const glm::dvec3 across = lattice.step(d) - glm::dot(lattice.step(d), toViewer) * toViewer;
        const double band = 0.5 * glm::length(across) / pixelMm;
        const bool ends = image.reconstruction == scene::Reconstruction::bandLimited;
        return ends ? std::min(band, 0.5) : band;
    };
    alongBand = bandOf(along);
    std::size_t next = 0;
    for (int d = 0; d < 3; ++d)
        if (d != along)
            axes[next++] = shearedAxis(lattice, box, d, along, view[d] / view[along], bandOf(d));
}

std::size_t ShearedGrid::bytes() const {
    const auto product = [](double a, double b) { return std::size_t(a * b); };
    const ShearedAxis &inRow = axes[0], &across = axes[1];
    // The last two at once: what is transformed, twice, and what is read.
    const std::size_t sums = product(inRow.cells, across.cells),
                      transformed = product(inRow.reach() + fourier::Kernel::largestWidth,
                                            2.0 * across.padded),
                      read = product(inRow.reach() + 2.0 * fourier::Kernel::largestWidth,
                                     2.0 * across.reach() + fourier::Kernel::largestWidth);
    return (sums + 2 * (transformed + read)) * sizeof(float);
}

} // namespace pellucid::plan
