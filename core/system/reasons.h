// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(needsMemory, "needs %1 MB of memory, but only %2 MB are available")
PELLUCID_REASON(noMemoryForPages, "not enough memory for %1 (%2 MB)")
// clang-format on

} // namespace pellucid::task::because
