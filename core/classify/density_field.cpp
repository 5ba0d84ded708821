// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/density_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/task/error.h"
#include "core/volume/statistics.h"

namespace pellucid::classify {

namespace {

using volume::united;
using volume::VoxelBox;

// Replaces an empty box by the middle sample.
VoxelBox orMiddle(const VoxelBox &box, volume::GridSize size) {
    if (box.hi.i > box.lo.i)
        return box;
    return {{size.i / 2, size.j / 2, size.k / 2}, {size.i / 2 + 1, size.j / 2 + 1, size.k / 2 + 1}};
}

// The smallest box around the values that are not 0.
VoxelBox supportOf(const volume::Field &field, const task::Progress &progress) {
    const volume::GridSize size = field.lattice().size();
    const VoxelBox box = tbb::parallel_reduce(
        tbb::blocked_range<int>(0, size.k), VoxelBox{},
        [&](const tbb::blocked_range<int> &range, VoxelBox sum) {
            std::vector<float> buffer(std::size_t(size.i));
            for (int k = range.begin(); k != range.end(); ++k) {
                progress.check();
                for (int j = 0; j < size.j; ++j) {
                    const float *const row = field.row({0, j, k}, size.i, buffer.data());
                    const float *const end = row + size.i;
                    const auto isSet = [](float f) { return f != 0.0F; };
                    const float *const first = std::find_if(row, end, isSet);
                    if (first == end)
                        continue;
                    const auto last = std::find_if(std::make_reverse_iterator(end),
                                                   std::make_reverse_iterator(first), isSet)
                                          .base();
                    sum = united(sum, {{int(first - row), j, k}, {int(last - row), j + 1, k + 1}});
                }
            }
            return sum;
        },
        united);
    return orMiddle(box, size);
}

} // namespace

FieldWindow defaultFieldWindow(const volume::Volume &volume) {
    if (volume.unit() == volume::ValueUnit::hounsfield)
        return ctFieldWindow;
    if (volume.unit() == volume::ValueUnit::uptake)
        return uptakeFieldWindow;
    if (volume.notes().isDifference) {
        const auto ends = volume::quantiles(volume, {0.0025, 0.9975});
        return {0.0, std::max({std::abs(ends[0]), std::abs(ends[1]), 1e-6})};
    }
    const auto q = volume::quantiles(volume, {0.005, 0.995});
    return {q[0], q[1]};
}

DensityField densityField(const volume::Volume &volume, const FieldWindow &window,
                          const task::Progress &progress) {
    const double width = window.high - window.low;
    return fieldOf({volume, {float(window.low), width > 0.0 ? float(1.0 / width) : 0.0F}},
                   progress);
}

DensityField fieldOf(const volume::Field &like, std::vector<float> samples) {
    return fieldOf(volume::Volume(like.lattice(), std::move(samples), volume::ValueUnit::none,
                                  like.samples().notes()));
}

DensityField fieldOf(volume::Field values, const task::Progress &progress) {
    const VoxelBox support = supportOf(values, progress);
    progress.report(1.0);
    return {std::move(values), support};
}

} // namespace pellucid::classify
