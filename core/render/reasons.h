// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(anImageOfThisSize, "an image of this size")

// Scenes, plans and engines
PELLUCID_REASON(nothingVisible, "nothing is visible, so there is no spectrum to show")
PELLUCID_REASON(cpuEngine, "CPU engine, %1, %2 threads")
PELLUCID_REASON(cpuEngineOfOneThread, "CPU engine, %1, %2 thread")
PELLUCID_REASON(sumsAlongTheView, "sums along the view, %1")
// clang-format on

} // namespace pellucid::task::because
