// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/class_region.h"

#include <utility>

#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::Region;
using volume::Coverage;
using volume::GridSize;
using volume::VoxelBox;

// `shareOf`: of a sample, given its place and its offset in the grid.
template <class F> Coverage regionWhere(const GridSize &size, const F &shareOf) {
    VoxelBox box;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j) {
            int first = size.i, last = -1;
            for (int i = 0; i < size.i; ++i)
                if (shareOf(volume::VoxelIndex{i, j, k}, size.offsetOf(i, j, k)) != 0) {
                    first = std::min(first, i);
                    last = i;
                }
            if (last >= 0)
                box = united(box, {{first, j, k}, {last + 1, j + 1, k + 1}});
        }
    Coverage region{box, {}};
    region.shares.reserve(box.size().count());
    for (int k = box.lo.k; k < box.hi.k; ++k)
        for (int j = box.lo.j; j < box.hi.j; ++j)
            for (int i = box.lo.i; i < box.hi.i; ++i)
                region.shares.push_back(
                    shareOf(volume::VoxelIndex{i, j, k}, size.offsetOf(i, j, k)));
    return region;
}

} // namespace

Coverage regionOf(const GridSize &size, const Mask &mask) {
    return regionWhere(size, [&](volume::VoxelIndex, std::size_t n) {
        return mask[n] != 0 ? std::uint8_t(Coverage::whole) : std::uint8_t(0);
    });
}

Coverage regionOf(const volume::Volume &volume, classify::TissueClass tissue,
                  classify::StepRunner &runner, const task::Progress &progress) {
    tissue.edge = 0.0;
    const classify::ClassSamples samples = samplesOf(volume, tissue, &runner, progress);
    return task::orOutOfMemory(task::because::noMemoryForTheSteps(tissue.name), [&] {
        return samples.values.visit([&](auto values) {
            return regionWhere(
                volume.lattice().size(), [&](volume::VoxelIndex at, std::size_t n) -> std::uint8_t {
                    const Region where = samples.regions ? (*samples.regions)[n] : Region::inside;
                    if (where == Region::filled)
                        return Coverage::whole;
                    if (where == Region::outside || tissue.membership(double(values[n])) < 0.5)
                        return 0;
                    return samples.coverage ? samples.coverage->at(at)
                                            : std::uint8_t(Coverage::whole);
                });
        });
    });
}

} // namespace pellucid::preprocess
