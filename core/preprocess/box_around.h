// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/preprocess/filters.h"

namespace pellucid::preprocess {

/// The smallest box that contains the samples of a mask; of no samples if it is empty.
volume::VoxelBox boxAround(const volume::GridSize &size, const Mask &mask);

} // namespace pellucid::preprocess
