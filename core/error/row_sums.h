// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

namespace pellucid::error {

/// The vector loops of exact sums. Sixteen frequencies are in the lanes of a block, and eight rows
/// of samples share the loads of a table of cosines and sines.
struct RowGroup {
    static constexpr int rows = 8, lanes = 16;

    /// The samples of each row in pairs at the same distance from the middle of the row: sums for
    /// the cosines, differences for the sines, which halves the multiplications. *Shape*:
    /// [row][pair]; the pairs before `firstPair` are zero in all rows.
    std::array<const float *, rows> sums{}, differences{};
    int firstPair = 0, pairs = 0;
};

/// Adds up rows at the frequencies of one block, and adds the results, turned by each row's own
/// phase, to a plane's sums: a float sum for a row, doubles across rows. *Shape*: `table`:
/// [pair][16 cosines, 16 sines]; `phases`: of each row, [16 cosines, 16 sines]; `real`,
/// `imaginary`: 16 each.
void addRows(const RowGroup &group, const float *table,
             const std::array<const double *, RowGroup::rows> &phases, double *real,
             double *imaginary);

/// Whether all samples of a row are zero; if not, its samples in pairs, see RowGroup. *Shape*: the
/// middle sample of an odd number is the last of `sums`, with the difference 0. Returns the first
/// pair that is not zero, or -1.
int foldRow(const float *samples, int count, float *sums, float *differences);

} // namespace pellucid::error
