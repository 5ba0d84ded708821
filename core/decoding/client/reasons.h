// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(changedWhileRead, "changed while it was being read")
PELLUCID_REASON(isNotWritable, "cannot be written")

// Memory
PELLUCID_REASON(needsTooMuchMemory, "needs more memory than is available")
PELLUCID_REASON(noMemoryForTheVolume, "not enough memory for the volume")
PELLUCID_REASON(noMemoryForADecoder, "not enough memory to start the decoder")

// The decoding process
PELLUCID_REASON(implausibleAnswer, "was decoded to implausible data")
PELLUCID_REASON(takesTooLong, "takes too long to read")
PELLUCID_REASON(decoderCannotStart, "the decoder cannot be started: %1")
PELLUCID_REASON(decoderCrashed, "is so damaged that the decoder crashed")
PELLUCID_REASON(decoderBrokeItsConfinement, "made the decoder attempt a forbidden system call")
PELLUCID_REASON(decoderWasKilled, "its decoder was killed, perhaps because memory ran out")
PELLUCID_REASON(decoderIsGone, "the decoder has exited")
PELLUCID_REASON(doesNotAnswer, "it does not respond")

// Archives
PELLUCID_REASON(isEncrypted, "is encrypted")
PELLUCID_REASON(isALinkInAnArchive, "is a link in an archive")
PELLUCID_REASON(holdsTooManyFiles, "contains more than %1 files")
PELLUCID_REASON(holdsMoreFilesThanAnnounced, "contains more files than it lists")
PELLUCID_REASON(unpacksToMoreThanAnnounced, "unpacks to more than its stated size")
PELLUCID_REASON(unpacksToMoreThanThereIsRoom, "unpacks to more than the %1 available")

// DICOM files
PELLUCID_REASON(isAnIndex, "is an index of files, not an image")
PELLUCID_REASON(listsAFileOutside, "refers to a file outside its folder")
PELLUCID_REASON(hasNoPixels, "has no pixel data")
PELLUCID_REASON(hasNoPixelsBut, "has no pixel data (%1)")
PELLUCID_REASON(isAColorImage, "is a color image (%1)")
PELLUCID_REASON(isASegmentation, "is a segmentation, which is shown with the images that it belongs to")
PELLUCID_REASON(announcesTooManyFrames, "declares more frames than the file can hold: %1")
PELLUCID_REASON(hasAnImageWithoutSize, "has an image without rows or columns")
PELLUCID_REASON(hasATooLargeImage, "has an image larger than DICOM allows")
PELLUCID_REASON(hasSeveralSamples, "has %1 samples per pixel; monochrome images have one")
PELLUCID_REASON(hasUnsupportedBits, "has %1-bit samples, which are not supported")
PELLUCID_REASON(storesImplausibleBits, "has contradictory attributes: Bits Stored %1, Bits Allocated %2, High Bit %3")
PELLUCID_REASON(hasFloatingPointPixels, "has floating-point pixels, which are not supported")
PELLUCID_REASON(doesNotSayWhetherSigned, "does not say whether its values are signed")
PELLUCID_REASON(unsupportedSyntax, "has an unsupported transfer syntax: %1")

// Segmentations
PELLUCID_REASON(isNoSegmentation, "is not a segmentation")
PELLUCID_REASON(hasNoSegments, "describes no segments")

// Pixels
PELLUCID_REASON(compressedDataDamaged, "the compressed data is damaged or truncated")

// Labels that distinguish the volumes of a series
PELLUCID_REASON(bValue, "b-value %1")
PELLUCID_REASON(heartInterval, "heart interval %1")
PELLUCID_REASON(timeSlot, "time slot %1")
PELLUCID_REASON(phase, "phase %1")
PELLUCID_REASON(timeSlice, "time %1")
PELLUCID_REASON(energyWindow, "energy window %1")
PELLUCID_REASON(detector, "detector %1")
PELLUCID_REASON(percentOfCycle, "%1 %")
PELLUCID_REASON(echoTime, "echo time %1 ms")
PELLUCID_REASON(inversionTime, "inversion time %1 ms")
PELLUCID_REASON(gradientDirection, "direction %1")
PELLUCID_REASON(flipAngle, "flip angle %1°")
PELLUCID_REASON(tubeVoltage, "%1 kVp")
PELLUCID_REASON(reconstructionKernel, "kernel %1")
PELLUCID_REASON(milliseconds, "%1 ms")
PELLUCID_REASON(stack, "stack %1")
PELLUCID_REASON(echo, "echo %1")
PELLUCID_REASON(type, "type %1")
PELLUCID_REASON(acquisition, "acquisition %1")
PELLUCID_REASON(acquisitionTime, "acquisition time %1")
PELLUCID_REASON(contentTime, "content time %1")
PELLUCID_REASON(temporalPosition, "temporal position %1")

// Volume files
PELLUCID_REASON(holdsFewerVolumes, "contains fewer volumes than before")
PELLUCID_REASON(rescaleGivesNoValues, "has an unusable rescale slope or intercept")
PELLUCID_REASON(moreSamplesThanDeclared, "the file contains more samples than its header says")
PELLUCID_REASON(samplesNotFinite, "samples that are not finite numbers: %1")
PELLUCID_REASON(namesNoSpace, "the file names no patient space; left-posterior-superior is assumed")
PELLUCID_REASON(samplesMissing, "its sample file is missing: %1")
// clang-format on

} // namespace pellucid::task::because
