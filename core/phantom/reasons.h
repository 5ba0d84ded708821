// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForThePhantom, "not enough memory for a phantom of this size")

// Phantoms
PELLUCID_REASON(unknownPhantom, "unknown phantom '%1': use one of %2")
PELLUCID_REASON(tiltOutOfRange, "the tilt must be between -57 and 57 degrees")
PELLUCID_REASON(phantomSizeOutOfRange, "phantom sizes must be 1 to 4096 and spacings positive")
// clang-format on

} // namespace pellucid::task::because
