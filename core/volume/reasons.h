// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(noMemoryForAField, "not enough memory for a field of %1 x %2 x %3")

// Labels that distinguish the volumes of a series
PELLUCID_REASON(axialNumber, "axial %1")
PELLUCID_REASON(coronalNumber, "coronal %1")
PELLUCID_REASON(sagittalNumber, "sagittal %1")
PELLUCID_REASON(imagesNumber, "images %1")
PELLUCID_REASON(axial, "axial")
PELLUCID_REASON(coronal, "coronal")
PELLUCID_REASON(sagittal, "sagittal")
PELLUCID_REASON(images, "images")

// Volume files
PELLUCID_REASON(planesNotAtRightAngles, "the planes are not at right angles")
PELLUCID_REASON(valuesAreOne, "its values, from %1 to %2, are too close together for single precision")
PELLUCID_REASON(valuesAreShownAsEqual, "values that differ by less than %1 are shown as equal")
PELLUCID_REASON(axisWithoutSamples, "the volume has no samples along one axis")
PELLUCID_REASON(moreSamplesThanAnyMachineHolds, "the volume has more samples than any machine can hold")
PELLUCID_REASON(geometryNotFinite, "the geometry has numbers that are not finite")
PELLUCID_REASON(stepsSpanNoVolume, "the voxel axes do not span a volume")
// clang-format on

} // namespace pellucid::task::because
