// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(noMemoryForTheDifference, "not enough memory for the difference of two volumes")
PELLUCID_REASON(subtractionWeightOutOfRange, "the weight %1 is not between %2 and %3")
PELLUCID_REASON(volumesDoNotOverlap, "the two volumes do not overlap")
// clang-format on

} // namespace pellucid::task::because
