// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(isNotReadable, "cannot be read: %1")
PELLUCID_REASON(isDamaged, "is damaged")

// The decoding process
PELLUCID_REASON(decoderCannotBeSetUp, "the decoder cannot be set up")
PELLUCID_REASON(unsupportedRequest, "was requested in a way that the decoder does not support")

// Archives
PELLUCID_REASON(isADamagedArchive, "is a damaged archive")
PELLUCID_REASON(isADamagedArchiveBy, "is a damaged archive: %1")
PELLUCID_REASON(isDamagedInTheArchive, "is damaged in the archive: %1")

// DICOM files
PELLUCID_REASON(holdsNoData, "contains no data")
PELLUCID_REASON(hasTooManyElements, "has too many data elements for an image")
PELLUCID_REASON(isNestedTooDeeply, "has sequences nested too deeply")

// Segmentations
PELLUCID_REASON(hasTooManySegments, "describes more than %1 segments")
PELLUCID_REASON(describesSegmentTwice, "describes segment %1 twice")
PELLUCID_REASON(segmentNumberOutOfRange, "has a segment number outside 1 to 65535")
PELLUCID_REASON(frameHasUnknownSegment, "has a frame of segment %1, which it does not describe")
PELLUCID_REASON(frameHasNoPlace, "has a frame without a position, an orientation or a pixel spacing")
PELLUCID_REASON(unknownSegmentationType, "has an unknown segmentation type: '%1'")
PELLUCID_REASON(maskIsCompressed, "has compressed one-bit pixels, which are not supported")
PELLUCID_REASON(maskHasOtherBits, "has %1 bits per pixel instead of %2")
PELLUCID_REASON(fractionOutOfRange, "has a maximum fractional value outside 1 to 65535")
PELLUCID_REASON(structureNumberTwice, "has two structures with the number %1")
PELLUCID_REASON(contourOfUnknownStructure, "has contours of structure %1, which it does not describe")
PELLUCID_REASON(contourIsDamaged, "has a contour with damaged coordinates: structure '%1'")
PELLUCID_REASON(hasNoContours, "has no closed contours")
PELLUCID_REASON(hasTooManyPoints, "has more than %1 contour points")

// Pixels
PELLUCID_REASON(pixelsNotReadable, "the pixel data cannot be read")
PELLUCID_REASON(pixelsTruncated, "the pixel data is truncated")
PELLUCID_REASON(pixelsTruncatedTo, "the pixel data is truncated: %1 of %2 samples")
PELLUCID_REASON(compressedPixelsNotReadable, "the compressed pixel data cannot be read")
PELLUCID_REASON(fragmentNotReadable, "a fragment of the compressed pixel data cannot be read")
PELLUCID_REASON(noFragments, "the compressed pixel data has no fragments: %1")
PELLUCID_REASON(holdsOtherFrames, "has a wrong number of compressed frames: %1 instead of %2")
PELLUCID_REASON(frameHasNoHeader, "a compressed frame has no header")
PELLUCID_REASON(frameHasOtherSize, "a compressed frame has %1 x %2 pixels, but the header says %3 x %4")
PELLUCID_REASON(frameHasColors, "a compressed frame has %1 color components")
PELLUCID_REASON(frameHasOtherBits, "a compressed frame has %1 bits per sample, but the header says %2")
PELLUCID_REASON(frameHasOtherCoding, "a compressed frame does not match its transfer syntax (marker %1): %2")
PELLUCID_REASON(runsHaveNoHeader, "a run-length frame has no header")
PELLUCID_REASON(runsHaveWrongOffsets, "a run-length frame has wrong offsets")
PELLUCID_REASON(runsHaveOtherSegments, "a run-length frame has a wrong number of segments: %1 instead of %2")
PELLUCID_REASON(runSegmentIsShort, "a run-length segment decodes to a wrong number of bytes: %1 instead of %2")
PELLUCID_REASON(runSegmentIsLong, "a run-length segment has more bytes than its image needs: %1")
PELLUCID_REASON(compressedImageContradictsHeader, "the compressed image does not match the header")
PELLUCID_REASON(imageContradictsHeader, "the image does not match the header")
PELLUCID_REASON(jpeg2000, "JPEG 2000: %1")
PELLUCID_REASON(jpegXl, "JPEG XL: %1")
PELLUCID_REASON(damagedHeader, "damaged header")
PELLUCID_REASON(damagedOrTruncated, "damaged or truncated")
PELLUCID_REASON(holdsNoImage, "contains no image")
PELLUCID_REASON(compressedDataTruncated, "truncated")

// Volume files
PELLUCID_REASON(isNoVolumeFile, "is not a NRRD, NIfTI or MetaImage file")
PELLUCID_REASON(sizeOutOfRange, "the size of the volume is out of range")
PELLUCID_REASON(volumeTooLarge, "the volume is too large")
PELLUCID_REASON(originTooFar, "the origin is more than a kilometer away")
PELLUCID_REASON(samplesTooCloseOrFar, "the sample spacing is less than a nanometer or more than ten metres")
PELLUCID_REASON(holdsColors, "contains colors; only one value per voxel is supported")
PELLUCID_REASON(holdsSeveralValues, "has several values per voxel; only one is supported")
PELLUCID_REASON(holdsTooManyVolumes, "contains too many volumes")
PELLUCID_REASON(niftiType, "NIfTI data type %1 is not supported")
PELLUCID_REASON(niftiHasNoDimensions, "the NIfTI header has no valid dimensions")
PELLUCID_REASON(niftiSaysNoPlace, "the NIfTI header does not say where the samples are")
PELLUCID_REASON(niftiSamplesElsewhere, "has its samples in another file; only single-file NIfTI (.nii) is supported")
PELLUCID_REASON(metaImageLineWithoutEquals, "the MetaImage header has a line without '='")
PELLUCID_REASON(metaImageHasNo, "the MetaImage header has no '%1'")
PELLUCID_REASON(metaImageNumbers, "the MetaImage header has '%1' where numbers are expected")
PELLUCID_REASON(metaImageType, "MetaImage type '%1' is not supported")
PELLUCID_REASON(metaImageDimensions, "only three- and four-dimensional MetaImage volumes are supported")
PELLUCID_REASON(metaImageText, "MetaImage samples as text are not supported")
PELLUCID_REASON(metaImageList, "MetaImage samples in a list of files are not supported")
PELLUCID_REASON(metaImageHeaderSize, "a negative MetaImage HeaderSize is not supported")
PELLUCID_REASON(nrrdDimensions, "only three-dimensional NRRD volumes are supported")
PELLUCID_REASON(nrrdHasTwice, "the NRRD header has '%1' twice")
PELLUCID_REASON(nrrdHasNoEnd, "the NRRD header has no end")
PELLUCID_REASON(nrrdHasNo, "the NRRD header has no '%1'")
PELLUCID_REASON(nrrdSpaceUnits, "NRRD space units '%1' are not supported")
PELLUCID_REASON(nrrdUnits, "NRRD units '%1' are not supported")
PELLUCID_REASON(isNoNrrdFile, "is not a NRRD file")
PELLUCID_REASON(nrrdLineWithoutColon, "the NRRD header has a line without a colon")
PELLUCID_REASON(nrrdNumbers, "the NRRD header has '%1' where numbers are expected")
PELLUCID_REASON(nrrdSpace, "NRRD space '%1' is not supported")
PELLUCID_REASON(nrrdVectorWithoutEnd, "the NRRD vector has no closing bracket: %1")
PELLUCID_REASON(nrrdDirections, "the NRRD header must have three space directions")
PELLUCID_REASON(nrrdOrigin, "the NRRD header must have one space origin")
PELLUCID_REASON(nrrdType, "NRRD type '%1' is not supported")
PELLUCID_REASON(nrrdEncoding, "NRRD encoding '%1' is not supported")
PELLUCID_REASON(nrrdEndian, "NRRD endian '%1' is not supported")
PELLUCID_REASON(nrrdField, "the NRRD field '%1' is not supported")
PELLUCID_REASON(isNoNiftiFile, "is not a NIfTI file")
// clang-format on

} // namespace pellucid::task::because
