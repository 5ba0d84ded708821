// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/files/session_folder.h"
#include "core/task/progress.h"
#include "ui/library/library.h"

namespace pellucid::ui {

/// `refer`: the library references the files in place; `copy`: it copies them, as from a CD.
enum class ImportMode { refer, copy };

struct Import {
    std::vector<std::filesystem::path> paths;
    ImportMode mode = ImportMode::refer;
    /// Called on the import's thread when all is listed.
    std::function<void()> listed{};
};

struct ImportResult {
    int series = 0, files = 0;
    std::vector<dicom::Skipped> skipped;
};

/// Scans paths and adds their series to the library, with thumbnails. If part of a series is in the
/// library already, the rest joins it. The contents of archives are always copied. An error or a
/// cancel leaves the library unchanged. *Throws* Error{unusable} if there is nothing to import,
/// Error{output} if the library cannot be written, Cancelled.
ImportResult importStudies(const LibraryPlace &place, const Import &import,
                           const task::Progress &progress);

/// The copies of a removed study, which `finish` deletes. Their names are on disk until then: if
/// the program ends first, the next one finds and deletes the copies.
struct Removal {
    std::vector<std::filesystem::path> copies;
    std::shared_ptr<files::SessionFolder> names;
};
/// Removes a study from the list. *Throws* Error{output}.
Removal removeStudy(Library &library, const StudyFacts &study);
/// Deletes the copies. *Throws* Error{output} if the list cannot be read; the next start of the
/// program tries again.
void finish(const Removal &removal, Library &library);

/// Adds copies whose rows a damaged list has lost; existing rows do not change. *Throws*
/// Error{output}, Cancelled; the next start of the program tries again.
ImportResult relistCopies(const LibraryPlace &place, const task::Progress &progress);

/// What to do with copies of a killed import that have their final names but no row: `kept` if a
/// damaged list may have lost the rows.
enum class LeftCopies { removed, kept };

/// Whether an import is unfinished, in a program that is running or that was killed.
bool hasUnfinishedImports(const LibraryPlace &place);
/// Deletes the files that killed imports left in the library's folder. *Throws* Error{output} if
/// the list cannot be read; the next call deletes the rest.
void removeAbandonedImports(Library &library, LeftCopies left);

} // namespace pellucid::ui
