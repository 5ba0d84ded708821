// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/volume/coverage.h"

namespace pellucid::preprocess {

/// The coverage of a grid in its smallest box. `shareOf`: the share of a sample, given its place
/// and its offset in the grid; is called from several threads.
template <class F>
volume::Coverage coverageWhere(const volume::GridSize &size, const F &shareOf) {
    std::vector<volume::VoxelBox> boxes(std::size_t(size.k)); // of each slice
    tbb::parallel_for(0, size.k, [&](int k) {
        for (int j = 0; j < size.j; ++j) {
            const std::size_t row = size.offsetOf(0, j, k);
            const auto isCovered = [&](int i) {
                return shareOf(volume::VoxelIndex{i, j, k}, row + std::size_t(i)) != 0;
            };
            int first = 0, last = size.i - 1;
            while (first <= last && !isCovered(first))
                ++first;
            if (first > last)
                continue;
            while (!isCovered(last))
                --last;
            volume::VoxelBox &box = boxes[std::size_t(k)];
            box = united(box, {{first, j, k}, {last + 1, j + 1, k + 1}});
        }
    });
    volume::Coverage covered;
    for (const volume::VoxelBox &box : boxes)
        covered.box = united(covered.box, box);
    const volume::VoxelBox &box = covered.box;
    covered.shares.resize(box.size().count());
    tbb::parallel_for(box.lo.k, box.hi.k, [&](int k) {
        for (int j = box.lo.j; j < box.hi.j; ++j) {
            std::uint8_t *out = covered.shares.data() + covered.offsetOf({box.lo.i, j, k});
            for (int i = box.lo.i; i < box.hi.i; ++i)
                *out++ = shareOf(volume::VoxelIndex{i, j, k}, size.offsetOf(i, j, k));
        }
    });
    return covered;
}

} // namespace pellucid::preprocess
