// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

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

/// Removes what a killed import left in the library's folder. Copies that had their names already
/// go too, unless the list, which has no row of theirs, may have lost it.
void removeAbandonedImports(Library &library, bool listIsWhole);

} // namespace pellucid::ui
