// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForTheReference, "not enough memory for the exact reference")
PELLUCID_REASON(noMemoryForTheExactShadedField, "not enough memory for the exact shaded field")

// Scenes, plans and engines
PELLUCID_REASON(exactReference, "exact reference, double precision")
// clang-format on

} // namespace pellucid::task::because
