// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/widths/width_map.h"

namespace pellucid::widths {

/// Sixteen frequencies of a tile, one in each column. Unless they are in one row, one in each row,
/// too: bright frequencies that lie on a line have at most 6 of them.
struct SliceLine {
    int strip = 0, tile = 0;
    int first = 0; ///< the row of column 0, from the tile's first row
    int rise = 0;  ///< rows from a column to the next, modulo those of the tile; 0 or odd

    int rowOf(int column) const {
        return tile * SliceTiles::rows + (first + rise * column) % SliceTiles::rows;
    }
};

/// The squared errors of a line by the width that reads it: its distance from what the widest
/// kernel reads, with that of its mirror image. Width 0 reads nothing. *Units*: as the energies.
using ErrorsByWidth = std::array<double, fourier::Kernel::largestWidth + 1>;

/// Measures lines by all the widths. *Shape*: the result has an entry for each line.
using MeasureLines = std::function<std::vector<ErrorsByWidth>(std::span<const SliceLine>)>;

/// Chooses the widths of a slice's tiles. Most frequencies of a picture have almost no energy: a
/// narrow kernel is accurate enough for them, or they need not be read. The error of a width is
/// roughly a constant share of the energy around it, so the fastest choice for a given error uses
/// each width within a range of energies. The ranges are measured: every width reads a few
/// lines, half of them where the best choice has equal errors, and the ranges move up until the
/// measured error plus a margin reaches the budget. The widest kernel always reads the
/// tiles around frequency 0. *Shape*: `energies` as `tileEnergies`; `widths`: 0, then ascending to
/// the widest. *Units*: `budget` is the squared error, a sum over both halves of the plane, in
/// units of the energies. *Source*: REFERENCES.md, eq. 6.
WidthMap chooseWidths(const SliceTiles &tiles, std::span<const float> energies, double budget,
                      std::span<const int> widths, const MeasureLines &measure);

} // namespace pellucid::widths
