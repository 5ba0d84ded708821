// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// The study library, sessions and export
PELLUCID_REASON(ofLibrary, "the study library: %1")
PELLUCID_REASON(isALibraryOfAnotherVersion, "is a study library from another version of the program")
PELLUCID_REASON(listedForThisRun, "%1; studies are listed only until the program closes")
PELLUCID_REASON(copiesNeedALibrary, "copying needs a study library that can be written to")
PELLUCID_REASON(cannotBeCopied, "cannot be copied into the library: %1")
PELLUCID_REASON(referredNotCopied, "has its samples in another file; imported by reference, not copied")
PELLUCID_REASON(notImported, "has its samples in another file; not imported")

// The study library
PELLUCID_REASON(libraryIsDamaged, "the study library is damaged: %1")
PELLUCID_REASON(libraryWasRebuilt, "the study library was damaged; series recovered: %1, lost: %2; the old file is kept under this name")
PELLUCID_REASON(libraryWasNotReadable, "the study library was damaged and nothing could be recovered; the old file is kept under this name")
PELLUCID_REASON(libraryWasEmpty, "the study library was empty; its copied studies are listed again")
PELLUCID_REASON(cannotBeRebuilt, "is damaged, and a new one cannot be written: %1")
PELLUCID_REASON(noDataFolder, "your data folder cannot be written to; nothing is saved, and studies are listed only until the program closes")
PELLUCID_REASON(copiesNeedRoom, "the copies need %1 MB, but only %2 MB are free")
// clang-format on

} // namespace pellucid::task::because
