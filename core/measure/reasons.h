// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(ofMeasurement, "measurement %1: %2")
PELLUCID_REASON(isNoListOfMeasurements, "is not a list of measurements (%1)")
PELLUCID_REASON(mustHavePoints, "it must have %1 points")
PELLUCID_REASON(mustHaveFromToPoints, "it must have %1 to %2 points")
PELLUCID_REASON(regionsAreNotProjected, "regions are measured in planes, not in projections")
PELLUCID_REASON(directionsNotAtRightAngles, "its directions are not at right angles")
// clang-format on

} // namespace pellucid::task::because
