// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/field_roughness.h"

#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace pellucid::plan {

namespace {

// A row of samples and its four neighbours: above and below in the same plane, before and after in
// the adjacent planes.
template <class T> struct RowAndNeighbours { const T *here, *above, *below, *before, *after; };

// Adds the squares at the samples of a row and at the two samples beyond its ends.
template <class T> void addSquares(const RowAndNeighbours<T> &rows, int count, double &sum) {
    const T *const here = rows.here;
    float inRow = 0.0F;
    for (int i = 0; i < count; ++i) {
        const float twice = 2.0F * float(here[i]);
        const float down = float(rows.above[i]) + float(rows.below[i]) - twice,
                    deep = float(rows.before[i]) + float(rows.after[i]) - twice;
        inRow += down * down + deep * deep;
    }
    for (int i = 1; i + 1 < count; ++i) {
        const float across = float(here[i - 1]) + float(here[i + 1]) - 2.0F * float(here[i]);
        inRow += across * across;
    }
    sum += double(inRow);
    for (const int end : {0, count - 1}) {
        const double f = double(here[end]);
        const double next = count > 1 ? double(here[end == 0 ? 1 : end - 1]) : 0.0;
        sum += (next - 2.0 * f) * (next - 2.0 * f) + f * f;
    }
}

// The sum of squares of a plane, including the rows beyond its ends.
template <class Samples>
double squaresOfPlane(const Samples &samples, const volume::GridSize &lattice,
                      const volume::VoxelBox &box, int k) {
    using T = typename Samples::value_type;
    const volume::GridSize size = box.size();
    const std::vector<T> none(std::size_t(size.i));
    const auto row = [&](int j, int depth) {
        const bool isInside = j >= 0 && j < size.j && depth >= 0 && depth < size.k;
        return isInside
                   ? samples.data() + lattice.offsetOf(box.lo.i, j + box.lo.j, depth + box.lo.k)
                   : none.data();
    };
    double sum = 0.0;
    for (int j = -1; j <= size.j; ++j)
        addSquares<T>({row(j, k), row(j - 1, k), row(j + 1, k), row(j, k - 1), row(j, k + 1)},
                      size.i, sum);
    return sum;
}

} // namespace

double squaredSecondDifferences(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size(), size = box.size();
    std::vector<double> planeSums(std::size_t(size.k));
    field.visit([&](auto samples) {
        tbb::parallel_for(0, size.k, [&](int k) {
            planeSums[std::size_t(k)] = squaresOfPlane(samples, lattice, box, k);
        });
    });
    double sum = 0.0;
    for (const double planeSum : planeSums)
        sum += planeSum;
    // The planes beyond the first and last one.
    field.visit([&](auto samples) {
        for (const int k : {box.lo.k, box.hi.k - 1})
            for (int j = box.lo.j; j < box.hi.j; ++j)
                for (int i = box.lo.i; i < box.hi.i; ++i) {
                    const double f = double(samples[lattice.offsetOf(i, j, k)]);
                    sum += f * f;
                }
    });
    return sum;
}

} // namespace pellucid::plan
