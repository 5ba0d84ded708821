// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Servers on the network
PELLUCID_REASON(onlyCapturesAreSent, "only DICOM pictures can be sent; choose a DICOM format")

// Recipes
PELLUCID_REASON(recipesAreOfProjections, "recipes make projections; choose the projection")
PELLUCID_REASON(recipesAreOfOneVolume, "recipes cannot subtract volumes yet")

// Export
PELLUCID_REASON(projectionIsNotPrepared, "the projection is not computed (F5 to recompute)")
PELLUCID_REASON(projectionIsBeingMade, "The projection is still being computed")
PELLUCID_REASON(valuesOfTheProjectionOnly, "Only the projection can be exported as values")
PELLUCID_REASON(onlyTheProjectionTurns, "Only the projection can be exported as a turntable")
PELLUCID_REASON(picturesHaveAtMost, "Pictures can have at most %1 pixels a side")
// clang-format on

} // namespace pellucid::task::because
