// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/mask.h"

#include "core/preprocess/coverage_where.inc"

namespace pellucid::preprocess {

volume::VoxelBox boxAround(const volume::GridSize &size, const Mask &mask) {
    return boxWhere(size, [&](volume::VoxelIndex, std::size_t n) { return mask[n] != 0; });
}

volume::Coverage regionOf(const volume::GridSize &size, const Mask &mask) {
    return coverageWhere(size, [&](volume::VoxelIndex, std::size_t n) {
        return mask[n] != 0 ? std::uint8_t(volume::Coverage::whole) : std::uint8_t(0);
    });
}

} // namespace pellucid::preprocess
