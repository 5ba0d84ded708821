// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/volume/coverage.h"

namespace pellucid::preprocess {

/// A set of samples. *Shape*: one of each sample, 0 or 1.
using Mask = std::vector<std::uint8_t>;

/// The smallest box that contains the samples of a mask; of no samples if it is empty.
volume::VoxelBox boxAround(const volume::GridSize &size, const Mask &mask);

/// A mask as a region: its smallest box, with shares of 0 and 255.
volume::Coverage regionOf(const volume::GridSize &size, const Mask &mask);

} // namespace pellucid::preprocess
