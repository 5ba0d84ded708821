// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/kernels_by_width.h"

namespace pellucid::plan {

/// The mean squared error of a frequency in each block of cells, by the width of the kernel that
/// reads it. Width 0 reads nothing: its error is the energy.
///
/// It is measured at a few points. The mean over a plane through a block is at most half the error
/// at its brightest cell, except by chance: a line of cells, which the plane may contain, fills a
/// fifth of the block. There the points are on the grid or halfway between cells, as in views along
/// an axis, where aliases are in phase; others are anywhere.
struct SpectrumBlocks {
    SpectrumBlocks(const fourier::Spectrum &spectrum, const fourier::KernelsByWidth &kernels);

    /// The position of a width's error among those of a block.
    static int entryOf(int width) { return width == 0 ? 0 : width - 1; }

    int step;                       ///< cells of a block along x; 8 along y and z
    int columns, rows, planes;      ///< of blocks
    std::array<float, 3> firstCell; ///< of the first block, by axis
    int widest;
    int entries;               ///< of a block: 4 or 8
    std::vector<float> errors; ///< *Shape*: [plane][row][column][entry]. *Units*: cells squared

    /// The weights of a point in the grid by tap and entry; the point reads `widest` taps an axis
    /// from its first on, and narrower kernels have zeros there.
    struct PointWeights {
        static constexpr std::size_t entries = 8;
        using Axis = std::array<std::array<float, entries>, fourier::Kernel::largestWidth>;
        alignas(64) std::array<Axis, 3> axis;
    };
    /// On the grid; halfway between cells along each axis and along all; anywhere.
    static constexpr std::size_t pointCount = 16, pointsInPhase = 5;
    std::array<PointWeights, pointCount> points;
};

/// Measures the blocks of one column and plane. Every error of a block without cells brighter than
/// `dark` is the energy of its brightest cells.
void measureBlocks(const fourier::Spectrum &spectrum, int column, int plane, float dark,
                   SpectrumBlocks &blocks);

/// Points in a spectrum whose errors are to be added.
struct PointSum {
    const SpectrumBlocks *blocks = nullptr;
    std::size_t count = 0;
    bool takesLargest = false; ///< instead of the sum
    /// By axis: the cells of the points from a first cell on. *Shape*: whole vectors of 16.
    std::array<const float *, 3> cells{};
    std::array<float, 3> first{}, padded{};
    std::array<float, 3> reach{};   ///< of each point. *Units*: cycles per sample
    const float *factors = nullptr; ///< the reconstruction's squared factor from there on
    float factorsPerCycle = 0.0F;
    int lastFactor = 0;
};

/// Adds the errors of the points, by entry, times the squared factor of the reconstruction. Every
/// instruction set comes to the same sums of the same errors. *Shape*: eight errors.
void sumErrors(const PointSum &sum, float *errors);

} // namespace pellucid::plan
