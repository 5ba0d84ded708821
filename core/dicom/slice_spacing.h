// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

namespace pellucid::dicom {

// The depths of the slices of a stack, and the even grids that they lie on. Depths are sorted.
// *Units*: mm.

/// Positions that differ by less are not rounded.
inline constexpr double exactMm = 1e-6;

/// The largest distance of a slice from its place on an even grid: positions are often written with
/// one decimal.
double evennessToleranceMm(double spacingMm);

/// From each depth to the next. *Shape*: one entry less.
std::vector<double> gapsOf(const std::vector<double> &depths);

/// The upper of two in the middle. *Shape*: not empty.
double median(std::vector<double> values);

/// depth = start + index * step, by least squares.
struct SliceLine {
    double startMm = 0.0, stepMm = 0.0;
    double worstMm = 0.0; ///< the largest distance of a slice from its place
    bool isEven() const { return worstMm <= evennessToleranceMm(stepMm); }
};

/// A line on which every frame has a place of its own.
struct EvenGrid {
    SliceLine line;
    std::vector<long> indices; ///< of the frames
};

/// The grid on which every frame is a slice; slices may be missing. Nothing if there is none.
std::optional<EvenGrid> evenGrid(const std::vector<double> &depths,
                                 const std::vector<double> &gaps);

/// The grid for an uneven stack. It goes through its longest even run, or through one that is much
/// finer and no accident: nothing that was scanned finely is to be lost. Nothing if the grid would
/// have far more slices than there are frames.
std::optional<SliceLine> anchoredLine(const std::vector<double> &depths);

} // namespace pellucid::dicom
