// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/task/progress.h"
#include "core/task/reason.h"

namespace pellucid::decoder {

class Decoder;

/// What an archive may become, so that a small file cannot fill a disk.
struct UnpackLimits {
    std::uintmax_t bytes = std::uintmax_t(64) << 30; ///< never more than half of what is free
    std::size_t files = 500'000;
};

/// A file of an archive that is not unpacked, under its name there, and why.
struct LeftOutFile {
    std::string name;
    task::Reason reason;
    bool operator==(const LeftOutFile &) const = default;
};

/// Whether a file begins as a ZIP archive does.
bool isArchive(const std::filesystem::path &path);

/// Writes the regular files of a ZIP archive below a folder, under their names in the archive.
/// Names that lead out of the folder lose what leads out. *Returns* what is left out: links, and
/// files whose data are damaged. *Throws* Error{unusable} if the archive itself is damaged, holds
/// very many damaged files, is encrypted, or announces or gives more than the limits allow (it is
/// refused by its directory, before anything is written); Error{output}; Cancelled.
std::vector<LeftOutFile> unpackArchive(Decoder &decoder, const std::filesystem::path &archive,
                                       const std::filesystem::path &folder,
                                       const task::Progress &progress = {},
                                       const UnpackLimits &limits = {});

} // namespace pellucid::decoder
