// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/dicom/decoded_files.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

struct ScanOptions {
    /// Also uses images that are unusually large, or need far more memory than their files have
    /// bytes.
    bool includesHuge = false;
    /// Files whose headers are known already; may be null.
    const DecodedFiles *decoded = nullptr;
    /// The files are part of what was opened last, such as an archive whose studies are scanned one
    /// by one: the same decoders read them, see `Decoder::beginOpening`.
    bool isSameSource = false;
    /// Whether the files are all slices of their series.
    Slices slices = Slices::all;
};

/// Searches files, folders (recursively, without following links to folders), DICOMDIRs, ZIP
/// archives and NRRD files, and groups the images into series. Archives are unpacked only if the
/// caller names them, not within folders. Every file that is not used is listed in `skipped`.
/// *Throws* Error{unusable} if a path does not exist, a folder named by the caller cannot be read,
/// or the only archive is refused; Error{output} if an archive cannot be unpacked; Cancelled.
Catalogue scan(const std::vector<std::filesystem::path> &paths, const task::Progress &progress = {},
               const ScanOptions &options = {});

} // namespace pellucid::dicom
