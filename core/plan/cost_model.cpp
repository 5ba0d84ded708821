// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/cost_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pellucid::plan {

namespace {

// Relative times of a frequency sample by kernel width when its cells lie in the cache, with
// binary16 and with float cells, and of its part in the transforms.
constexpr std::array<double, 8> sampleTime{0.0, 0.4, 0.5, 0.7, 1.0, 1.7, 2.2, 2.9};
constexpr double floatCells = 1.4;
constexpr double transformTime = 0.2;
// The time to bring in what a cell of the slice's area adds for a width of 4: 6 ns beside the 24 of
// a sample.
constexpr double cellTime = 0.25;

} // namespace

double timeInCache(int width, fourier::Storage storage) {
    return transformTime + sampleTime[std::size_t(width)] *
                               (storage == fourier::Storage::float32 ? floatCells : 1.0);
}

double frameTime(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
                 const fourier::SpectrumLayout &layout) {
    // In cells, the slice of a view along an axis is as large as the other two axes are padded.
    const double i = layout.padded.i * lattice.spacingMm(0) / camera.pixelMm,
                 j = layout.padded.j * lattice.spacingMm(1) / camera.pixelMm,
                 k = layout.padded.k * lattice.spacingMm(2) / camera.pixelMm;
    const double area = (i * j + j * k + k * i) / 3.0;
    const double frequencies = double(grid.columns) * grid.rows;
    const double inCells =
        cellTime * (0.25 * layout.width()) * (double(bytesPerCell(layout.storage)) / 4.0) * area;
    // What is larger takes longer to prepare too: a twentieth for each doubling.
    const double doublings = std::max(0.0, std::log2(double(layout.bytes()) / double(1 << 20)));
    return (frequencies * timeInCache(layout.width(), layout.storage) + inCells) *
           (1.0 + 0.05 * doublings);
}

} // namespace pellucid::plan
