// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForTheStep, "not enough memory for the step '%1'")
PELLUCID_REASON(noMemoryForTheSteps, "not enough memory for the steps of the class '%1'")
PELLUCID_REASON(noMemoryToFindEdges, "not enough memory to find edges")

// Segmentations
PELLUCID_REASON(seedOutsideRange, "no value at the points to grow from is within the range")
PELLUCID_REASON(seedInANarrowPlace, "the points to grow from are in places narrower than the leak limit")
PELLUCID_REASON(segmentIsMissing, "the class '%1' needs the segment '%2', which is not loaded")

// Looks, classes and presets
PELLUCID_REASON(edgesNeedSamples, "edges by ITK need at least four samples along each axis; the fast method does not")
PELLUCID_REASON(edgesNeedASigma, "edges by ITK need a sigma_mm above 0")
// clang-format on

} // namespace pellucid::task::because
