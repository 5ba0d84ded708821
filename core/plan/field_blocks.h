// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/volume/field.h"

namespace pellucid::plan {

/// The first and last sample of a block along an axis, both inclusive.
struct BlockRange {
    int first = 0, last = 0;
};

/// The blocks into which an axis of `samples` samples is divided.
std::vector<BlockRange> blockRanges(int samples);

/// A block's shares of the field's energy and mass.
struct FieldBlock {
    std::array<std::uint8_t, 3> at{}; ///< index along each axis, see `blockRanges`
    float energy = 0.0F, mass = 0.0F; ///< shares of the whole field
};

/// The nonempty blocks of a field in a box divided by `blockRanges`. There are few of them, because
/// the planner visits all of them for each layout.
std::vector<FieldBlock> fieldBlocks(const volume::Field &field, const volume::VoxelBox &box);

} // namespace pellucid::plan
