// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/field_roughness.h"
#include "core/volume/lane_sum.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

namespace pellucid::plan {

namespace {

// A row of samples and its four neighbours: above and below in the same plane, before and after in
// the adjacent planes.
struct RowAndNeighbours {
    const float *here, *above, *below, *before, *after;
};

// The sum of squares at the samples of a row and at the two samples beyond its ends.
double squaresOfRow(const RowAndNeighbours &rows, int count) {
    const float *const here = rows.here;
    double sum = double(volume::laneSum(count, [&](int i) {
        const float twice = 2.0F * here[i], down = rows.above[i] + rows.below[i] - twice,
                    deep = rows.before[i] + rows.after[i] - twice;
        return down * down + deep * deep;
    }));
    sum += double(volume::laneSum(count - 2, [&](int i) {
        const float across = here[i] + here[i + 2] - 2.0F * here[i + 1];
        return across * across;
    }));
    for (const int end : {0, count - 1}) {
        const double f = double(here[end]);
        const double next = count > 1 ? double(here[end == 0 ? 1 : end - 1]) : 0.0;
        sum += (next - 2.0 * f) * (next - 2.0 * f) + f * f;
    }
    return sum;
}

// The sum of squares of a plane, including the rows beyond its ends.
double squaresOfPlane(const volume::Field &field, const volume::VoxelBox &box, int k) {
    const volume::GridSize size = box.size();
    const std::vector<float> none(std::size_t(size.i));
    // Three rows of the plane, and those before and after the middle one.
    std::array<std::vector<float>, 5> buffers;
    buffers.fill(none);
    const auto row = [&](int j, int depth, int buffer) {
        const bool isInside = j >= 0 && j < size.j && depth >= 0 && depth < size.k;
        return isInside ? field.row({box.lo.i, j + box.lo.j, depth + box.lo.k}, size.i,
                                    buffers[std::size_t(buffer)].data())
                        : none.data();
    };
    double sum = 0.0;
    const float *above = none.data(), *here = none.data();
    for (int j = -1; j <= size.j; ++j) {
        const float *const below = row(j + 1, k, (j + 1) % 3);
        sum += squaresOfRow({here, above, below, row(j, k - 1, 3), row(j, k + 1, 4)}, size.i);
        above = std::exchange(here, below);
    }
    return sum;
}

} // namespace

double squaredSecondDifferences(const volume::Field &field, const volume::VoxelBox &box) {
    const volume::GridSize size = box.size();
    std::vector<double> planeSums(std::size_t(size.k));
    tbb::parallel_for(0, size.k,
                      [&](int k) { planeSums[std::size_t(k)] = squaresOfPlane(field, box, k); });
    double sum = 0.0;
    for (const double planeSum : planeSums)
        sum += planeSum;
    // The planes beyond the first and last one.
    std::vector<float> buffer(std::size_t(size.i));
    for (const int k : {box.lo.k, box.hi.k - 1})
        for (int j = box.lo.j; j < box.hi.j; ++j) {
            const float *const row = field.row({box.lo.i, j, k}, size.i, buffer.data());
            sum += double(volume::laneSum(size.i, [&](int i) { return row[i] * row[i]; }));
        }
    return sum;
}

} // namespace pellucid::plan
