// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(projectionNeedsMemory, "the projection needs %1 MB, but only %2 MB are allowed")
PELLUCID_REASON(mostAccurate, "the most accurate available")
PELLUCID_REASON(mostAccurateThatFits, "the most accurate that fits in memory")
PELLUCID_REASON(fastest, "the fastest that meets the tolerance")
PELLUCID_REASON(mostAccurateWith, "the most accurate with the chosen %1")
PELLUCID_REASON(mostAccurateThatFitsWith, "the most accurate that fits in memory with the chosen %1")
PELLUCID_REASON(onePicture, "for one picture, summing along the view is faster than computing a spectrum")
PELLUCID_REASON(kernel, "kernel")
PELLUCID_REASON(padding, "padding")
PELLUCID_REASON(storage, "storage")
PELLUCID_REASON(both, "%1, %2")
PELLUCID_REASON(fastestWith, "the fastest that meets the tolerance with the chosen %1")
PELLUCID_REASON(detailIsLargerThanTheVolume, "the size of detail is larger than the radius of the volume")
PELLUCID_REASON(sliceIsTooLarge, "pixels of %1 mm at a pan of %2 mm need a slice of more than %3 frequencies a side")
PELLUCID_REASON(projectionNeedsTooManyCells, "the projection needs more cells than an engine can count")
// clang-format on

} // namespace pellucid::task::because
