// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/volume/coverage.h"

namespace pellucid::preprocess {

/// The smallest box that contains the samples that are chosen; of no samples if none are.
/// `isChosen`: given the place of a sample and its offset in the grid; is called from several
/// threads.
template <class F> volume::VoxelBox boxWhere(const volume::GridSize &size, const F &isChosen) {
    std::vector<volume::VoxelBox> boxes(std::size_t(size.k)); // of each slice
    tbb::parallel_for(0, size.k, [&](int k) {
        volume::VoxelBox box;
        for (int j = 0; j < size.j; ++j) {
            const std::size_t row = size.offsetOf(0, j, k);
            const auto isIn = [&](int i) {
                return isChosen(volume::VoxelIndex{i, j, k}, row + std::size_t(i));
            };
            int first = 0, last = size.i - 1;
            while (first <= last && !isIn(first))
                ++first;
            if (first > last)
                continue;
            while (!isIn(last))
                --last;
            box = united(box, {{first, j, k}, {last + 1, j + 1, k + 1}});
        }
        boxes[std::size_t(k)] = box;
    });
    volume::VoxelBox all;
    for (const volume::VoxelBox &box : boxes)
        all = united(all, box);
    return all;
}

/// The coverage of a grid in its smallest box. `shareOf`: the share of a sample, given as for
/// `boxWhere`.
template <class F> volume::Coverage coverageWhere(const volume::GridSize &size, const F &shareOf) {
    const volume::VoxelBox box =
        boxWhere(size, [&](volume::VoxelIndex at, std::size_t n) { return shareOf(at, n) != 0; });
    volume::Coverage covered{box, std::vector<std::uint8_t>(box.size().count())};
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
