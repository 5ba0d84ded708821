// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// What JSON should hold; `at`: where in it, or in which file
PELLUCID_REASON(mustBeAFileName, "must be a name of 1 to %1 letters, digits, '-', '_', '.' and ','")

// Recipes
PELLUCID_REASON(loopNeedsViews, "needs a turntable or several views")
PELLUCID_REASON(viewsAreGivenTwice, "has more than one of view, views and turntable; only view and turntable go together")
PELLUCID_REASON(nameIsTaken, "another output has the name '%1'")
PELLUCID_REASON(needsANameOfItsOwn, "needs a name: its default, '%1', is the name of another output")
PELLUCID_REASON(nameIsReserved, "the name '%1' is reserved for the record of the results")
PELLUCID_REASON(fitHasNoChoice, "cannot be met with both pixel_mm and size; remove one")
PELLUCID_REASON(matricesDecideTheFit, "cannot be met: the matrices determine what a picture contains")
PELLUCID_REASON(deidentifyIsForDicom, "is for the formats dicom and dicom-loop: other formats contain no identity")
PELLUCID_REASON(holdsOtherThanResults, "contains '%1', which is not a result; choose an empty folder")
PELLUCID_REASON(holdsNoResults, "is not a folder of results, and would be replaced")
PELLUCID_REASON(matrixBelongsToViews, "is a matrix, which belongs to 'views'")
PELLUCID_REASON(noSeriesIsChosen, "no series of the study matches the recipe")

// Export
PELLUCID_REASON(colorsHaveNoGreyValues, "A picture in color has no grey values: export it as it looks, or as NumPy values")
// clang-format on

} // namespace pellucid::task::because
