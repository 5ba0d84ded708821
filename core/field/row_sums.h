// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/field/row_reader.h"

namespace pellucid::field {

/// Sums and maxima over rows, by sample along the row. Floats round the sum of n rows by less than
/// n/2 ulp of the sum of magnitudes.
struct RowTotals {
    float *energy, *mass, *maxima; ///< of a row of blocks
    float *inPlane, *inRows;       ///< maxima: in one plane; of one row in all planes
};
void addRow(const float *row, int count, const RowTotals &to);

/// The sums of a part of a row. Eight lanes add up in a fixed order, so that every instruction set
/// gives the same bits.
struct PartSums {
    float energy = 0.0F, mass = 0.0F;
    float least = 0.0F; ///< at most 0
};
PartSums partSums(const float *part, int count);
/// The sum of the squares of the second differences down and across the planes, and of those along
/// the row except at its ends. Every instruction set gives the same bits.
double squaredDifferences(const RowAndNeighbours &rows, int count);

} // namespace pellucid::field
