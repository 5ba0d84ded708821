// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForABasisField, "not enough memory for a basis field")
PELLUCID_REASON(noMemoryForTheClassFields, "not enough memory for the class fields")

// Segmentations
PELLUCID_REASON(edgeOutOfRange, "the soft edge of %1 samples is outside 0 to %2")

// Looks, classes and presets
PELLUCID_REASON(classHasNoName, "a class has no name")
PELLUCID_REASON(ofClass, "class '%1': %2")
PELLUCID_REASON(rangeIsEmpty, "the range %1 to %2 is empty")
PELLUCID_REASON(softnessIsNegative, "the softness must be 0 or more")
PELLUCID_REASON(stepHasNoParameters, "the step '%1' has no parameters")
PELLUCID_REASON(stepHasOtherParameters, "the step '%2' has no parameter '%1'; it has %3")
PELLUCID_REASON(stepIsUnknown, "unknown step '%1': use one of %2")
PELLUCID_REASON(weightOutOfRange, "the weight %1 of a transfer function is not between 0 and %2")
PELLUCID_REASON(curveRangeInvalid, "the range of a transfer function must be within 0 to 1 and at least %1 wide")
PELLUCID_REASON(weightsOutOfRange, "a transfer function must have %1 to %2 weights, not %3")
PELLUCID_REASON(isNoColor, "'%1' is not a color of the form #rrggbb")
PELLUCID_REASON(colorOutOfRange, "the color components must be between 0 and 1")
PELLUCID_REASON(classWeightOutOfRange, "the weight %1 is not between 0 and %2")
PELLUCID_REASON(hasTooManySteps, "has %1 steps; at most %2 are allowed")
PELLUCID_REASON(tooManyClasses, "there are %1 classes; at most %2 are allowed")
PELLUCID_REASON(stepMustComeBefore, "the step '%1' must come before '%2'")
PELLUCID_REASON(stepsCannotRun, "the steps of the class '%1' cannot be run here")
PELLUCID_REASON(stepParameterOutOfRange, "%1 of the step '%2' is %3, not between %4 and %5")
PELLUCID_REASON(stepParameterNotWhole, "%1 of the step '%2' is %3, not a whole number")
PELLUCID_REASON(stepLowAboveHigh, "low is above high in the step '%1'")
PELLUCID_REASON(isDrawnAndASegment, "is drawn and cannot be a segment, too")
PELLUCID_REASON(combinesTooDeep, "classes within classes are nested too deep")
PELLUCID_REASON(stepNeedsAClass, "the step '%1' needs another class")
PELLUCID_REASON(classIsMissing, "the steps of the class '%1' need the class '%2', which the look does not have")
PELLUCID_REASON(severalClassesOfThatName, "the steps of the class '%1' need the class '%2', and the look has several of that name")
PELLUCID_REASON(classCombinesItself, "the steps of the class '%1' combine it with itself")
PELLUCID_REASON(combinesTooManyClasses, "the steps of the class '%1' combine more than %2 classes")
PELLUCID_REASON(pointsOutOfRange, "the number of points is %1, not between %2 and %3")
PELLUCID_REASON(pointIsNotFinite, "a point is not finite")
PELLUCID_REASON(hasTooManyStrokes, "the step '%1' has %2 strokes or cuts; at most %3 are allowed")
PELLUCID_REASON(ballOutOfRange, "the radius of %1 mm is not between %2 and %3 mm")
PELLUCID_REASON(sightIsNoUnitVector, "the line of sight of a cut is not a unit vector")
PELLUCID_REASON(slabIsEmpty, "the slab of a cut is empty")
PELLUCID_REASON(cropBoxOutOfRange, "the crop box needs 0 <= low < high <= 1 on every axis")
// clang-format on

} // namespace pellucid::task::because
