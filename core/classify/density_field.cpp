// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/density_field.h"

#include <algorithm>
#include <iterator>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/task/error.h"
#include "core/volume/statistics.h"

namespace pellucid::classify {

namespace {

using volume::united;
using volume::VoxelBox;

struct Mapping {
    float low, scale;
    template <class T> float operator()(T value) const {
        const float f = (float(value) - low) * scale;
        // NaN fails both comparisons and becomes 0.
        return f >= 1.0F ? 1.0F : f > 0.0F ? f : 0.0F;
    }
};

// Replaces an empty box by the middle sample.
VoxelBox orMiddle(const VoxelBox &box, volume::GridSize size) {
    if (box.hi.i > box.lo.i)
        return box;
    return {{size.i / 2, size.j / 2, size.k / 2}, {size.i / 2 + 1, size.j / 2 + 1, size.k / 2 + 1}};
}

template <class T>
VoxelBox mapSlices(std::span<const T> in, std::vector<float> &out, volume::GridSize size,
                   const Mapping &map, const task::Progress &progress) {
    return tbb::parallel_reduce(
        tbb::blocked_range<int>(0, size.k), VoxelBox{},
        [&](const tbb::blocked_range<int> &range, VoxelBox box) {
            for (int k = range.begin(); k != range.end(); ++k) {
                progress.check();
                for (int j = 0; j < size.j; ++j) {
                    const std::size_t row = size.offsetOf(0, j, k);
                    int first = size.i, last = -1;
                    for (int i = 0; i < size.i; ++i) {
                        const float f = map(in[row + i]);
                        out[row + i] = f;
                        if (f > 0.0F) {
                            first = std::min(first, i);
                            last = i;
                        }
                    }
                    if (last >= 0)
                        box = united(box, {{first, j, k}, {last + 1, j + 1, k + 1}});
                }
            }
            return box;
        },
        united);
}

} // namespace

FieldWindow defaultFieldWindow(const volume::Volume &volume) {
    if (volume.unit() == volume::ValueUnit::hounsfield)
        return {-900.0, 2000.0};
    const auto q = volume::quantiles(volume, {0.005, 0.995});
    return {q[0], q[1]};
}

DensityField densityField(const volume::Volume &volume, const FieldWindow &window,
                          const task::Progress &progress) {
    const volume::GridSize size = volume.lattice().size();
    const double width = window.high - window.low;
    const Mapping map{float(window.low), width > 0.0 ? float(1.0 / width) : 0.0F};
    return task::orOutOfMemory(task::because::noMemoryForAField(size.i, size.j, size.k), [&] {
        std::vector<float> values(size.count());
        const VoxelBox box = volume.visit([&](auto samples) {
            using T = std::remove_const_t<typename decltype(samples)::element_type>;
            return mapSlices<T>(samples, values, size, map, progress);
        });
        progress.report(1.0);
        return DensityField{volume::Volume(volume.lattice(), std::move(values),
                                           volume::ValueUnit::none, volume.notes()),
                            orMiddle(box, size)};
    });
}

DensityField fieldOf(const volume::Volume &like, std::vector<float> samples) {
    const volume::GridSize size = like.lattice().size();
    const VoxelBox box = tbb::parallel_reduce(
        tbb::blocked_range<int>(0, size.k), VoxelBox{},
        [&](const tbb::blocked_range<int> &range, VoxelBox sum) {
            for (int k = range.begin(); k != range.end(); ++k)
                for (int j = 0; j < size.j; ++j) {
                    const float *const row = samples.data() + size.offsetOf(0, j, k);
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
            return sum;
        },
        united);
    return {
        volume::Volume(like.lattice(), std::move(samples), volume::ValueUnit::none, like.notes()),
        orMiddle(box, size)};
}

} // namespace pellucid::classify
