// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/field_roughness.h"

#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace pellucid::plan {

namespace {

// A row of samples, and the four beside it.
template <class T> struct RowWithNeighbours {
    const T *here, *above, *below, *before, *after;
};

// The squared second differences at the samples of a row along all axes, and those along the row at
// the two samples beside its ends.
template <class T> double squaresAlong(const RowWithNeighbours<T> &rows, int count) {
    const auto &[here, above, below, before, after] = rows;
    float inRow = 0.0F;
    for (int i = 0; i < count; ++i) {
        const float twice = 2.0F * float(here[i]);
        const float down = float(above[i]) + float(below[i]) - twice,
                    deep = float(before[i]) + float(after[i]) - twice;
        inRow += down * down + deep * deep;
    }
    for (int i = 1; i + 1 < count; ++i) {
        const float across = float(here[i - 1]) + float(here[i + 1]) - 2.0F * float(here[i]);
        inRow += across * across;
    }
    return double(inRow);
}
