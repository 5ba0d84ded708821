// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(isNeitherFileNorFolder, "is neither a file nor a folder")
PELLUCID_REASON(emptyPath, "the path is empty")
PELLUCID_REASON(linksToAFolder, "is a link to a folder")
PELLUCID_REASON(isABrokenLink, "is a broken link")
PELLUCID_REASON(existsAlready, "already exists")

// Servers on the network
PELLUCID_REASON(otherFiles, "files that are not images: %1")

// Memory
PELLUCID_REASON(noMemoryForAVolume, "not enough memory for a volume of %1 x %2 x %3")

// Archives
PELLUCID_REASON(isAnArchive, "is an archive; open it separately")

// DICOM files
PELLUCID_REASON(isListedButMissing, "is listed in the DICOMDIR but missing")
PELLUCID_REASON(isUnusuallyLarge, "is unusually large: %1 x %2 x %3 pixels in a file of %4 MB")
PELLUCID_REASON(hasInstanceUidOf, "has the same instance UID as %1")
PELLUCID_REASON(attributeCannotBeSet, "attribute (%1) cannot be set")
PELLUCID_REASON(profileCannotBeWritten, "the code of the confidentiality profile cannot be written")
PELLUCID_REASON(compressionFailed, "compression failed: %1")
PELLUCID_REASON(unknownTransferSyntax, "unknown transfer syntax '%1': use one of %2")
PELLUCID_REASON(onlyWholeHuAreCt, "only volumes with whole HU values can be written as CT")

// Segmentations
PELLUCID_REASON(atRight, "at %1 mm right")
PELLUCID_REASON(atLeft, "at %1 mm left")
PELLUCID_REASON(atAnterior, "at %1 mm anterior")
PELLUCID_REASON(atPosterior, "at %1 mm posterior")
PELLUCID_REASON(atFeet, "at %1 mm towards the feet")
PELLUCID_REASON(atHead, "at %1 mm towards the head")

// Series and their geometry
PELLUCID_REASON(holdsNoUsableImages, "contains no usable images")
PELLUCID_REASON(holdsNoImages, "contains no images")
PELLUCID_REASON(noPosition, "the images have no position")
PELLUCID_REASON(noOrientation, "the images have no orientation")
PELLUCID_REASON(noPixelSpacing, "the images have no pixel spacing")
PELLUCID_REASON(slicesAtOnePosition, "all slices have the same position")
PELLUCID_REASON(imagesCannotBeToldApart, "several images have the same position, and nothing but their numbers tells them apart")
PELLUCID_REASON(slicesWithoutCommonStep, "slice spacings from %1 to %2 mm have no common step")
PELLUCID_REASON(sliceOffTheLine, "%1 is %2 mm off the line through all slices")
PELLUCID_REASON(gapAroundSlices, "slices %1 to %2 of %3: a gap of %4 mm between %5 and %6")
PELLUCID_REASON(gapAroundSlice, "slice %1 of %2: a gap of %3 mm between %4 and %5")
PELLUCID_REASON(shiftBesideSlices, "slices %1 to %2 of %3: the field of view shifts by %4 mm between %5 and %6")
PELLUCID_REASON(severalSeriesAre, "several series have the number '%1'; choose one by UID: %2")
PELLUCID_REASON(noSeries, "there is no series '%1'; available: %2")
PELLUCID_REASON(noVolumeBesideOne, "series %2 has no volume %1; it has only one")
PELLUCID_REASON(noVolumeInSeries, "series %2 has no volume %1; it has %3")
PELLUCID_REASON(othersMakeNoVolume, "%1; the other slices do not form a volume")
PELLUCID_REASON(fileNamed, "file %1")

// Warnings of series
PELLUCID_REASON(imagesOnly, "images only: %1")
PELLUCID_REASON(without, "%1 is not used: %2")
PELLUCID_REASON(missingSlices, "missing slices, interpolated: %1")
PELLUCID_REASON(toldApartByNumber, "guessed: images at the same position were told apart by their numbers alone")
PELLUCID_REASON(objectsOfStudyMissing, "the study is not complete: %1 of its objects are missing")
PELLUCID_REASON(slicesOfSeries, "%1 of %2 slices have arrived")
PELLUCID_REASON(more, "%1 more")
PELLUCID_REASON(unevenSlices, "uneven slice spacing, resampled to %1 mm; it changes at %2")
PELLUCID_REASON(unevenAt, "%1 (%2 then %3 mm)")
PELLUCID_REASON(orientationsDiffer, "orientations differ by up to %1 degrees; the mean is used")
PELLUCID_REASON(pixelSpacingsDiffer, "pixel spacings differ by up to %1 %; the mean is used")
PELLUCID_REASON(framesOfReferenceDiffer, "almost every image has its own frame of reference; treated as one")
PELLUCID_REASON(sameInstanceUid, "different images with the same instance UID: %1")
PELLUCID_REASON(namesSeveralStudies, "the images of this series belong to %1 studies; shown in the first")
PELLUCID_REASON(tilted, "tilted by %1 degrees; shown on its own slanted grid")
PELLUCID_REASON(implicitLabelledExplicit, "files labeled explicit VR but encoded as implicit VR: %1")
PELLUCID_REASON(pixelsOfDefinedLength, "files with a compressed transfer syntax but pixel data of defined length: %1")
PELLUCID_REASON(pixelsWithoutEnd, "files whose compressed pixel data is not terminated: %1")
PELLUCID_REASON(moreBitsThanDeclared, "files whose pixels have more bits than their header says: %1")
PELLUCID_REASON(placedBySpacing, "files with one position for all frames, which were placed in their order by the spacing between slices: %1")
PELLUCID_REASON(placedByThickness, "files with one position for all frames and no spacing, which were placed in their order by the slice thickness: %1")
PELLUCID_REASON(decimalCommas, "files with decimal commas, which were accepted: %1")
PELLUCID_REASON(numbersOfWrongType, "files whose numbers have a wrong value representation: %1")
PELLUCID_REASON(mosaicTilesGuessed, "mosaics without a number of slices, which were split by their acquisition matrix: %1")
PELLUCID_REASON(valuesAsStored, "without Rescale Slope or Intercept, unlike other images of the series: the values are taken as they are")
PELLUCID_REASON(rescaleIsAssumed, "no Rescale Slope and Intercept: the values are taken as HU")
PELLUCID_REASON(imagesDisagree, "the images state different values: %1")
PELLUCID_REASON(disagreementIn, "%1 (%2)")
PELLUCID_REASON(mosaicsShownFlat, "mosaics that could not be split into slices, shown as single images: %1")
PELLUCID_REASON(noUptakeValues, "the values are not SUV: %1")
PELLUCID_REASON(petUnitIs, "the files give them in the unit '%1'")
PELLUCID_REASON(severalInjections, "the files describe several injections")
PELLUCID_REASON(halfLifeIsWrong, "the half-life is not that of the radionuclide")
PELLUCID_REASON(uptakeIsOfType, "they are normalized by '%1', not by body weight")
PELLUCID_REASON(petFilesDiffer, "the files state different units, weights, injections or corrections")
PELLUCID_REASON(noPlausibleWeight, "the patient's weight is missing or implausible")
PELLUCID_REASON(noInjectedActivity, "the injected activity is missing or implausible")
PELLUCID_REASON(notAttenuationCorrected, "the files are not corrected for attenuation")
PELLUCID_REASON(notDecayCorrected, "the files are not corrected for decay")
PELLUCID_REASON(noDecayTime, "the time from injection to scan or the half-life is missing or implausible")
PELLUCID_REASON(surplusPixels, "files with more pixels than their header says: %1")
PELLUCID_REASON(zeroSlopes, "files with a rescale slope of 0, taken as 1: %1")
PELLUCID_REASON(damagedPixelsOf, "the compressed pixel data is damaged: %1")
PELLUCID_REASON(damagedPixels, "files whose compressed pixel data is damaged: %1")

// Labels that distinguish the volumes of a series
PELLUCID_REASON(slicesTo, "slices %1 to %2")
PELLUCID_REASON(slice, "slice %1")
PELLUCID_REASON(gapsFilled, "gaps filled")
PELLUCID_REASON(manyFiles, "many files")
PELLUCID_REASON(set, "set %1")
PELLUCID_REASON(others, "others")
PELLUCID_REASON(attributeIs, "%1 %2")
// clang-format on

} // namespace pellucid::task::because
