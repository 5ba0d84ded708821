// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryToKeepLayers, "not enough memory to keep the projections of the layers")

// Scenes, plans and engines
PELLUCID_REASON(imageNeedsMemory, "an image of %1 x %2 pixels needs %3 MB, but only %4 MB are allowed")
PELLUCID_REASON(reduced, "averaged to %1 x %2 x %3: the full %4 x %5 x %6 does not fit in memory")
// clang-format on

} // namespace pellucid::task::because
