// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/widths/width_map.h"

namespace pellucid::widths {

/// Sixteen neighbouring frequencies, one in each column of a strip. A diagonal crosses every row
/// and column of a tile's size: the brightest frequencies often form a line, which may be a row or
/// a column.
struct SliceLine {
    int strip = 0;
    int row = 0;   ///< of the first one
    int slope = 0; ///< rows from one to the next
    /// The frequencies before this one are in one tile, the others in the next.
    int split = SliceTiles::columns;
};

/// The squared errors of the two parts of a line by the width that reads them: their distance from
/// what the widest kernel reads, with that of their mirror images. Width 0 reads nothing.
/// *Units*: as the energies.
using ErrorsByWidth = std::array<double, fourier::Kernel::largestWidth + 1>;
using LineErrors = std::array<ErrorsByWidth, 2>;

/// Measures lines by all the widths. *Shape*: the result has an entry for each line.
using MeasureLines = std::function<std::vector<LineErrors>(std::span<const SliceLine>)>;

/// Chooses the widths of a slice's tiles. Most frequencies of a picture have almost no energy: a
/// narrow kernel is accurate enough for them, or they need not be read. The error of a width is
/// roughly a constant share of the energy around it, so the fastest choice for a given error uses
/// each width within a range of energies. The ranges are measured: every width reads a few
/// diagonals, most of them where the best choice has equal errors, and the ranges move up until the
/// measured error plus three standard errors reaches the budget. The widest kernel always reads the
/// tiles around frequency 0. *Shape*: `energies` as `tileEnergies`; `widths`: 0, then ascending to
/// the widest. *Units*: `budget` is the squared error, a sum over both halves of the plane, in
/// units of the energies. *Source*: REFERENCES.md, eq. 6.
WidthMap chooseWidths(const SliceTiles &tiles, std::span<const float> energies, double budget,
                      std::span<const int> widths, const MeasureLines &measure);

} // namespace pellucid::widths
