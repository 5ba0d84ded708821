// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <vector>

#include "core/plan/slice_grid.h"
#include "core/render/frame_job.h"

namespace pellucid::render {

/// The number of groups of 16 lines (columns of a strip, or rows) for this many lines.
inline int stripsOf(int lines) {
    return (lines + fourier::stripLanes - 1) / fourier::stripLanes;
}

/// exp(+i 2 pi n turns), n = 0..count-1, within 1e-13.
std::vector<std::complex<double>> rotations(int count, double turns);

/// Tables that depend only on the slice grid and the roll-off, kept from frame to frame.
struct GridTables {
    /// `count`: of strips, at most as many as half the grid has.
    GridTables(const plan::SliceGrid &grid, double rollOffShare, int count);

    plan::SliceGrid grid;
    double rollOffShare;
    fourier::StripTransform alongRows;           ///< length rows
    fourier::StripTransform halfColumns;         ///< length columns / 2
    std::vector<std::complex<float>> unpackReal; ///< see FrameJob::unpackReal
    std::vector<StripBounds> strips;             ///< the first ones
    std::vector<float> rollOff;                  ///< see StripBounds::rollOff
};

} // namespace pellucid::render
