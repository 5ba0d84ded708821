// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(contoursNotPlanar, "has contours that are not in parallel planes")
PELLUCID_REASON(contoursTooLarge, "has contours larger than any image")
PELLUCID_REASON(planesOfMasksDiffer, "has frames that are not parallel")
PELLUCID_REASON(belongsToAnotherStudy, "belongs to another study")
PELLUCID_REASON(hasAnotherFrameOfReference, "has a different frame of reference from the volume, so its positions do not apply")
PELLUCID_REASON(noSegmentInTheVolume, "has no segment within the volume")
PELLUCID_REASON(isNoLabelVolume, "is not a volume of labels: it must have at most 2000 different values, all whole numbers from 0 to 65535")
PELLUCID_REASON(segmentsResampled, "the segments are coarser than the volume, or lie across its slices; they were interpolated")
PELLUCID_REASON(contoursBetweenSlices, "contours lie between the slices, up to %1 mm from the nearest: %2")
PELLUCID_REASON(segmentsBetweenSamples, "the segments do not lie on the volume's samples (up to %1 mm away); they were interpolated")
PELLUCID_REASON(segmentNotInTheVolume, "the segment '%1' is outside the volume")
PELLUCID_REASON(segmentsNotInTheVolume, "segments outside the volume: %1")
PELLUCID_REASON(contoursWithoutArea, "open contours and points, which enclose nothing: %1")
PELLUCID_REASON(segmentationNotWritten, "the segmentation cannot be written: %1")
PELLUCID_REASON(segmentsOverlap, "the segments '%1' and '%2' overlap, which labels cannot express; write a DICOM segmentation")
PELLUCID_REASON(needsTooManyFrames, "needs %1 frames; a file has at most %2")
PELLUCID_REASON(noMemoryForTheSegments, "not enough memory for the segments")
// clang-format on

} // namespace pellucid::task::because
