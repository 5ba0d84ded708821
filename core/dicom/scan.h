// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

struct ScanOptions {
    /// Images that are unusually large, or that take far more memory than their files have bytes.
    bool takesHuge = false;
};

/// Looks through files, folders (all the way down; links to folders are not followed), DICOMDIRs,
/// ZIP archives and NRRD files, and groups what it finds. Archives are unpacked where the caller
/// names them, and not below folders. Every file that is not used is listed in `skipped`.
/// *Throws* Error{unusable} if a path does not exist, a folder named by the caller cannot be read
/// or the only archive is refused; Error{output} if an archive cannot be unpacked; Cancelled.
Catalogue scan(const std::vector<std::filesystem::path> &paths, const task::Progress &progress = {},
               const ScanOptions &options = {});

} // namespace pellucid::dicom
