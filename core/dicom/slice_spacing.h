// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

namespace pellucid::dicom {

// The depths of the slices of a stack, and even grids that fit them. *Shape*: depths are sorted.
// *Units*: mm.

/// Deviations below this are not the rounding of written positions.
inline constexpr double exactMm = 1e-6;

/// The largest distance of a slice from its place on an even grid; positions are often written with
/// one decimal.
double evennessToleranceMm(double spacingMm);

/// The distance from each depth to the next. *Shape*: one entry fewer than depths.
std::vector<double> gapsOf(const std::vector<double> &depths);

/// The median; of an even number of values, the upper of the middle two. *Shape*: not empty.
double median(std::vector<double> values);

/// depth = start + index * step, by least squares.
struct SliceLine {
    double startMm = 0.0, stepMm = 0.0;
    double worstMm = 0.0; ///< the largest distance of a slice from the line
    bool isEven() const { return worstMm <= evennessToleranceMm(stepMm); }
};

/// A line with a different index for each frame.
struct EvenGrid {
    SliceLine line;
    std::vector<long> indices; ///< by frame
};

/// The grid on which every frame is a slice; slices may be missing. No value if there is no such
/// grid.
std::optional<EvenGrid> evenGrid(const std::vector<double> &depths,
                                 const std::vector<double> &gaps);

/// The grid for an uneven stack. It fits the longest even run of frames, or a much finer run of at
/// least three gaps, so that no finely scanned part loses resolution. No value if the grid would
/// have far more slices than there are frames.
std::optional<SliceLine> anchoredLine(const std::vector<double> &depths);

} // namespace pellucid::dicom
