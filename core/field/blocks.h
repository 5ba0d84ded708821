// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pellucid::field {

/// The first and last sample of a block along an axis, both inclusive.
struct BlockRange {
    int first = 0, last = 0;
};

/// The blocks into which an axis of `samples` samples is divided. There are few of them, because
/// the planner visits all of them for each layout.
std::vector<BlockRange> blockRanges(int samples);

/// A block's shares of the field's energy and mass.
struct Block {
    std::array<std::uint8_t, 3> at{}; ///< index along each axis, see `blockRanges`
    float energy = 0.0F, mass = 0.0F; ///< shares of the whole field
};

} // namespace pellucid::field
