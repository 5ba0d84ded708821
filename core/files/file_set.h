// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/files/session_folder.h"

namespace pellucid::files {

/// Files of one folder that belong together, such as the frames of a turntable. They get their
/// names one after the other when all are on the disk; until then existing files of those names
/// remain. Discarded files leave nothing behind, and a kill leaves a hidden folder, which the next
/// set in that folder removes. A kill during the renames leaves some new and some old files.
class FileSet {
public:
    /// `file`: one of the set. *Throws* Error{output}.
    explicit FileSet(const std::filesystem::path &file);
    /// The temporary path for the file with this name, or for the target if the name is a link.
    /// *Shape*: with the same extension. *Throws* Error{output} if the name is that of a device or
    /// a pipe.
    std::filesystem::path aside(const std::filesystem::path &file);
    /// *Throws* Error{output}; files that already have their names keep them, and replace the old
    /// ones.
    void commit();

private:
    SessionFolder m_folder;
    std::vector<std::filesystem::path> m_files;
};

} // namespace pellucid::files
