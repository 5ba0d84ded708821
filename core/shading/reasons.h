// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForTheGradient, "not enough memory for the gradient of the field")
PELLUCID_REASON(noMemoryForTheLitField, "not enough memory for the lit field")

// What JSON should hold; `at`: where in it, or in which file

// Depth cue and light
PELLUCID_REASON(isNoNumber, "%1: '%2' is not a number")
PELLUCID_REASON(theCue, "the depth cue '%1'")
PELLUCID_REASON(theLight, "the light '%1'")
PELLUCID_REASON(isNoCue, "unknown depth cue '%1': use none, linear:S, sine:S or curve:c0,c1,...")
PELLUCID_REASON(isNoLight, "the light '%1' is not of the form u,v,w[:#rrggbb[:S]]")
PELLUCID_REASON(cueStrengthOutOfRange, "the strength of the depth cue must be between 0 and 1")
PELLUCID_REASON(cueCurveHasOtherSize, "the curve of the depth cue must have %1 to %2 values")
PELLUCID_REASON(cueCurveOutOfRange, "the values of the depth cue's curve must be between 0 and %1")
PELLUCID_REASON(ambientOutOfRange, "the ambient light must be between 0 and %1")
PELLUCID_REASON(tooManyLights, "at most %1 lights are allowed")
PELLUCID_REASON(lightHasNoDirection, "the direction of a light must be finite and not zero")
PELLUCID_REASON(lightStrengthOutOfRange, "the strength of a light must be between 0 and 1")
PELLUCID_REASON(lightColorOutOfRange, "the color components of a light must be between 0 and 1")
// clang-format on

} // namespace pellucid::task::because
