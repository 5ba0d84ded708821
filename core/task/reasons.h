// SPDX-License-Identifier: GPL-3.0-or-later
/// Sentences for every room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(isEmpty, "is empty")
PELLUCID_REASON(isNotARegularFile, "is not a regular file")
PELLUCID_REASON(isNotDicom, "is not a DICOM file")
PELLUCID_REASON(isDamagedBy, "is damaged: %1")
PELLUCID_REASON(inWords, "%1")

// Failures that the operating system reports
PELLUCID_REASON(noSuchFile, "No such file or directory")
PELLUCID_REASON(permissionDenied, "Permission denied")
PELLUCID_REASON(noSpaceLeft, "No space left on device")
PELLUCID_REASON(readOnlyFileSystem, "Read-only file system")
PELLUCID_REASON(isADirectory, "Is a directory")
PELLUCID_REASON(notPermitted, "Operation not permitted")
PELLUCID_REASON(quotaExceeded, "Disk quota exceeded")
PELLUCID_REASON(isNotADirectory, "Not a directory")
PELLUCID_REASON(nameTooLong, "File name too long")
PELLUCID_REASON(tooManyOpenFiles, "Too many open files")
PELLUCID_REASON(ioError, "Input/output error")
PELLUCID_REASON(fileTooLarge, "File too large")
PELLUCID_REASON(tooManyLinks, "Too many levels of symbolic links")
PELLUCID_REASON(isOpenElsewhere, "Another program has it open")
PELLUCID_REASON(systemReports, "the system reports: %1")

// Memory
PELLUCID_REASON(notEnoughMemory, "not enough memory")

// Warnings of series
PELLUCID_REASON(gapBetween, "%1 mm between %2 and %3")

// Looks, classes and presets
PELLUCID_REASON(stepFailed, "the step '%1' failed: %2")

// What JSON should hold; `at`: where in it, or in which file
PELLUCID_REASON(at, "%1: %2")

// The window
PELLUCID_REASON(faultOfTheProgram, "an internal error occurred; the log has the details")
// clang-format on

} // namespace pellucid::task::because
