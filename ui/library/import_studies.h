// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/files/session_folder.h"
#include "core/task/progress.h"
#include "ui/library/library.h"

namespace pellucid::ui {

/// `refer`: the files stay where they are; `copy`: the library has files of its own, as from a CD.
enum class ImportMode { refer, copy };

struct Import {
    std::vector<std::filesystem::path> paths;
    ImportMode mode = ImportMode::refer;
};

struct ImportResult {
    int series = 0, files = 0;
    std::vector<dicom::Skipped> skipped;
};

/// Scans paths and puts what they hold into the library, with thumbnails. A series of which a part
/// is there already gets the rest. What archives hold is always copied. All of it or, on an error
/// or when cancelled, nothing. *Throws* Error{unusable} if there is nothing to import,
/// Error{output} if it cannot be written, Cancelled.
ImportResult importStudies(const LibraryPlace &place, const Import &import,
                           const task::Progress &progress);

/// The copies of a study that is off the list, to be removed by `finish`. Their names are written
/// down till then: those that are still there when the program ends, however, are found by the next
/// one.
struct Removal {
    std::vector<std::filesystem::path> copies;
    std::shared_ptr<files::SessionFolder> names;
};
/// Takes a study off the list. *Throws* Error{output}.
Removal removeStudy(Library &library, const StudyFacts &study);
/// Removes the copies. *Throws* Error{output} if the list cannot be read: the next program tries
/// again.
void finish(const Removal &removal, Library &library);

/// Lists the library's own copies whose rows a damaged list has lost; what is listed stays as it
/// is. *Throws* Error{output}, Cancelled: the next program tries again.
ImportResult relistCopies(const LibraryPlace &place, const task::Progress &progress);

/// What becomes of the copies of a killed import that had their names but no row yet: `kept` where
/// the list may have lost the rows.
enum class LeftCopies { removed, kept };

/// Whether there is an import that has not ended; of a program that runs, or of one that was
/// killed.
bool hasUnfinishedImports(const LibraryPlace &place);
/// Removes what a killed import left in the library's folder. *Throws* Error{output} if the list
/// cannot be read: the rest is left to the next time.
void removeAbandonedImports(Library &library, LeftCopies left);

} // namespace pellucid::ui
