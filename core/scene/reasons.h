// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForAnImage, "not enough memory for an image of this size")

// Segmentations
PELLUCID_REASON(sceneShowsADifference, "the scene shows a difference of two volumes; subtract the other volume first")

// Scenes, plans and engines
PELLUCID_REASON(sceneIsNotValid, "the scene is not valid: %1")
PELLUCID_REASON(imageSizeOutOfRange, "the image size must be 1 to %1 pixels a side")
PELLUCID_REASON(matrixIsNotParallel, "is not the matrix of a parallel projection: the third row must be 0, 0, 0 and a number other than 0")
PELLUCID_REASON(pixelsOfMatrixAreNotSquare, "does not project on square pixels: the first three numbers of the first two rows must be perpendicular and of the same length")
PELLUCID_REASON(pixelsOfViewsDiffer, "has a different pixel size from earlier matrices")
PELLUCID_REASON(matricesNeedASize, "needs a size: give --size with --matrix")
PELLUCID_REASON(pixelMustBePositive, "the pixel size must be positive")
PELLUCID_REASON(panMustBeFinite, "the pan must be finite")
PELLUCID_REASON(orientationIsZero, "the orientation must not be zero")
PELLUCID_REASON(rollOffOutOfRange, "the roll-off must be between 0 and 1")
PELLUCID_REASON(isNoAngulation, "'%1' is not an angulation. Write, for example, 'LAO 30 CRA 20': LAO or RAO up to 180 degrees, CRA or CAU up to 90")
PELLUCID_REASON(detailOutOfRange, "the amplification of detail must be between 0 and 4, its size between 0.01 and 20 mm")
PELLUCID_REASON(contrastOutOfRange, "detail and latitude must be between 0 and 1")
PELLUCID_REASON(exposureIsNotPlausible, "invalid exposure: the lower end of each range must be below the upper end")
PELLUCID_REASON(toleranceMustBePositive, "the tolerance must be positive")
PELLUCID_REASON(paddingOutOfRange, "the padding must be between 1 and 4")
PELLUCID_REASON(windowIsEmpty, "the window's low end must be below its high end")
PELLUCID_REASON(volumeNeedsALargerImage, "the whole volume at a pixel size of %2 mm needs an image of more than %1 pixels a side; set a size or a larger pixel size")

// What JSON should hold; `at`: where in it, or in which file
PELLUCID_REASON(mustBeThreeRowsOfFour, "must be three rows of four numbers")
PELLUCID_REASON(mustNotBeEmpty, "must not be empty")
// clang-format on

} // namespace pellucid::task::because
