// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(cannotBeRemoved, "cannot be removed: %1")

// Looks, classes and presets
PELLUCID_REASON(presetNameIsTaken, "there is another preset named '%1'")
PELLUCID_REASON(noPresetFolder, "there is no folder for the user's presets")
PELLUCID_REASON(presetCannotBeKept, "the preset cannot be saved: %1")
PELLUCID_REASON(presetIsForOther, "the preset '%1' is made for %2, not for %3")
PELLUCID_REASON(isNoSlicerPreset, "is not a 3D Slicer volume property: %1")
PELLUCID_REASON(opacityIsZero, "its opacity is 0 everywhere")
PELLUCID_REASON(presetIsForHounsfield, "the preset '%1' is made for Hounsfield units, but the values may not be in HU")
PELLUCID_REASON(noPreset, "there is no preset '%1'; 'pellucid-cli preset list' lists the presets")
PELLUCID_REASON(noPresetBut, "there is no preset '%1'; similar names: %2")
PELLUCID_REASON(builtInPresetStays, "'%1' is built in and cannot be removed")
PELLUCID_REASON(builtInPresetNeedsAnotherName, "'%1' is built in and cannot be replaced; choose another name")
PELLUCID_REASON(endsBeforeItsOpacity, "the file ends before its scalar opacity")
PELLUCID_REASON(opacityHasNoCount, "the scalar opacity does not begin with the number of its values")
PELLUCID_REASON(opacityIsShort, "%1 values are declared, but only %2 are present")
PELLUCID_REASON(opacityValueOutOfRange, "the value %1 is out of range")
PELLUCID_REASON(opacityOutOfRange, "the opacity %1 at %2 is not between 0 and 1")
PELLUCID_REASON(opacityDoesNotChange, "its opacity does not change over any range of values")

// What JSON should hold; `at`: where in it, or in which file
PELLUCID_REASON(mustBeTwoRisingNumbers, "must be two numbers, the lower first")
PELLUCID_REASON(mustBeALine, "must be one line of 1 to %1 characters")
PELLUCID_REASON(mustBeValueOrWindow, "must be value or window")
// clang-format on

} // namespace pellucid::task::because
