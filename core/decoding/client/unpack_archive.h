// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/task/progress.h"
#include "core/task/reason.h"

namespace pellucid::decoding {

class Decoder;

/// Limits on unpacking, so that a small file cannot fill a disk.
struct UnpackLimits {
    std::uintmax_t bytes = std::uintmax_t(64) << 30; ///< and never more than half of the free space
    std::size_t files = 500'000;
};

/// A file that was not unpacked, under its name in the archive, and why.
struct LeftOutFile {
    std::string name;
    task::Reason reason;
    bool operator==(const LeftOutFile &) const = default;
};

/// Whether a file starts like a ZIP archive.
bool isArchive(const std::filesystem::path &path);

/// Writes the regular files of a ZIP archive below a folder, under their names in the archive.
/// Parts of names that lead out of the folder are removed. *Returns* the files that were left out:
/// links, and files with damaged data. *Throws* Error{unusable} if the archive itself is damaged,
/// has very many damaged files, is encrypted, or exceeds the limits (if its directory does, before
/// anything is written); Error{output}; Cancelled.
std::vector<LeftOutFile> unpackArchive(Decoder &decoder, const std::filesystem::path &archive,
                                       const std::filesystem::path &folder,
                                       const task::Progress &progress = {},
                                       const UnpackLimits &limits = {});

} // namespace pellucid::decoding
