// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// The files of one study, to be scanned. A volume file is one by itself, without a UID.
struct IndexedStudy {
    std::string uid;
    std::vector<std::filesystem::path> files;
};

/// Which images belong to which study, for archives whose headers do not fit in memory at once.
struct StudyIndex {
    std::vector<IndexedStudy> studies; ///< in the order of their first files
    std::vector<Skipped> skipped;      ///< with the paths to show to users
    /// The unpacked archives, kept as long as their files may be loaded.
    std::vector<Unpacked> unpacked;
};

/// Finds files as `scan` does, and reads of each header only where it belongs. *Throws* as `scan`.
StudyIndex indexStudies(const std::vector<std::filesystem::path> &paths,
                        const task::Progress &progress = {});

} // namespace pellucid::dicom
