// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(doesNotExist, "does not exist")
PELLUCID_REASON(isNoFolder, "is not a folder")
PELLUCID_REASON(isALinkOfAnotherUser, "is a link that another user made, in a folder where anybody may make files")
PELLUCID_REASON(isTruncated, "is truncated")
PELLUCID_REASON(cannotBeWritten, "cannot be written: %1")
PELLUCID_REASON(cannotBeMade, "cannot be created: %1")
PELLUCID_REASON(cannotBeMapped, "cannot be mapped: %1")
PELLUCID_REASON(cannotBeEncoded, "cannot be encoded: %1")
PELLUCID_REASON(isTooLargeForItsKind, "is larger than the %1 MB limit for this kind of file")
PELLUCID_REASON(noTemporaryFolder, "there is no folder for temporary files")
PELLUCID_REASON(atLine, "line %1: %2")
PELLUCID_REASON(isNotInAFolder, "is not in a folder")

// Servers on the network
PELLUCID_REASON(loopIsTooLarge, "the turntable would need more than %1 MB; choose fewer frames or a smaller size")

// The study library, sessions and export
PELLUCID_REASON(ffmpegDoesNotStart, "ffmpeg cannot be started")
PELLUCID_REASON(ffmpegEndedEarly, "ffmpeg ended early")

// What JSON should hold; `at`: where in it, or in which file
PELLUCID_REASON(memberIsGivenTwice, "the member '%1' is given twice")
PELLUCID_REASON(nestsTooDeeply, "lists and objects are nested too deeply")
PELLUCID_REASON(isNoJson, "not JSON: %1")
PELLUCID_REASON(mustBeANumber, "must be a number")
PELLUCID_REASON(mustBeNumbers, "must be a list of numbers")
PELLUCID_REASON(mustBeTwoNumbers, "must be two numbers")
PELLUCID_REASON(mustBeThreeNumbers, "must be three numbers")
PELLUCID_REASON(mustBeFourNumbers, "must be four numbers")
PELLUCID_REASON(mustHaveElements, "must be a list of length %1")
PELLUCID_REASON(mustBeWhole, "must be a whole number from %1 to %2")
PELLUCID_REASON(mustBeTrueOrFalse, "must be true or false")
PELLUCID_REASON(mustBeAText, "must be text")
PELLUCID_REASON(mustBeAList, "must be a list")
PELLUCID_REASON(mustBeAnObject, "must be an object")
PELLUCID_REASON(isOutOfRange, "is out of range")
PELLUCID_REASON(isNoneOf, "unknown value '%1': use one of %2")
PELLUCID_REASON(isNoMember, "unknown member '%1': use one of %2")
PELLUCID_REASON(isNot, "is not %1")
PELLUCID_REASON(hasNo, "has no %1")

// Export
PELLUCID_REASON(videosNeedFfmpeg, "Videos need ffmpeg, which is not installed; export frames instead")
PELLUCID_REASON(ffmpegReports, "ffmpeg: %1")
// clang-format on

} // namespace pellucid::task::because
