// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/cost_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pellucid::plan {

namespace {

// Relative times per frequency sample whose cells are in the cache: by kernel width, the factor for
// float cells, and the share of the transforms.
constexpr std::array<double, 8> sampleTime{0.0, 0.4, 0.5, 0.7, 1.0, 1.7, 2.2, 2.9};
constexpr double floatCells = 1.4;
constexpr double transformTime = 0.2;
// The time to fetch one more cell of the slice's area from memory, for a width of 4: 6 ns on one
// thread, where a sample takes 24 ns.
constexpr double cellTime = 0.25;

} // namespace

double readTime(int width) {
    return sampleTime[std::size_t(width)];
}

double timeInCache(int width, fourier::Storage storage) {
    return transformTime + sampleTime[std::size_t(width)] *
                               (storage == fourier::Storage::float32 ? floatCells : 1.0);
}

double frameTime(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
                 const fourier::SpectrumLayout &layout) {
    // A view along an axis has a slice of as many cells as the padded area of the other two axes.
    const double i = layout.padded.i * lattice.spacingMm(0) / camera.pixelMm,
                 j = layout.padded.j * lattice.spacingMm(1) / camera.pixelMm,
                 k = layout.padded.k * lattice.spacingMm(2) / camera.pixelMm;
    const double area = (i * j + j * k + k * i) / 3.0;
    const double frequencies = double(grid.columns) * grid.rows;
    const double inCells =
        cellTime * (0.25 * layout.width()) * (double(bytesPerCell(layout.storage)) / 4.0) * area;
    return frequencies * timeInCache(layout.width(), layout.storage) + inCells;
}

// Measured on two threads: 2.2 ns a padded sample, where a unit takes 8 ns.
double prepareTime(const volume::GridSize &padded) {
    return 0.3 * double(padded.count());
}

double sumTime(const ShearedGrid &grid, const volume::VoxelBox &box) {
    const ShearedAxis &along = grid.axes[0], &across = grid.axes[1];
    // Additions of a sample to the cells of its row, and of those to rows of cells.
    const int width = spreadKernel().width();
    const double cells = along.cellsPerSample,
                 additions = (along.isSpread ? std::max(double(width), cells) : 0.0) +
                             cells * (across.isSpread ? width : 1.0);
    // Measured on two threads, 512 x 512 x 400: 0.5 to 1.6 ns a sample, and 2 ns more where shifted
    // planes lie across the rows of the lattice; 4 ns a cell of the transform.
    const double reading = grid.along == 0 && (along.isSpread || across.isSpread) ? 0.3 : 0.05;
    return (reading + 0.007 * additions) * double(box.size().count()) +
           0.5 * double(along.padded) * double(across.padded);
}

bool widthsPay(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
               const volume::GridSize &padded, int pictures) {
    // Measured on a chest and a bonsai, 36 to 512 pictures of 256^2 to 1800 x 2000 pixels:
    // preparing the widths takes a third as long as preparing the spectrum; frames save two fifths
    // of the reading inside the samples' band, and all of it outside.
    constexpr double savedInside = 0.4;
    const double shortest = lattice.shortestStepMm();
    const double inside = std::min(1.0, std::pow(camera.pixelMm / shortest, 2));
    const double reading = double(grid.columns) * grid.rows * readTime(4);
    return pictures * reading * (1.0 - (1.0 - savedInside) * inside) > prepareTime(padded) / 3.0;
}

} // namespace pellucid::plan
