// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "core/decoding/client/instance.h"
#include "core/dicom/catalogue.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// The same path for every path to a file, as far as the system can tell.
std::filesystem::path resolved(const std::filesystem::path &path);

/// The files that paths refer to, each once: files, files in folders, files listed by a DICOMDIR,
/// and files in archives, which are unpacked.
class FileList {
public:
    /// *Requires*: `progress` outlives the list.
    explicit FileList(const task::Progress &progress);

    /// *Throws* Error{unusable} if the path does not exist, cannot be read or is refused,
    /// Error{output} if an archive cannot be unpacked; Cancelled.
    void add(const std::filesystem::path &path);

    std::vector<std::filesystem::path> found;
    std::vector<Skipped> skipped; ///< files that were found but are not used
    std::vector<Unpacked> unpacked;

private:
    void addFile(const std::filesystem::path &path);
    void addArchive(const std::filesystem::path &path);
    void addDirectory(const std::filesystem::path &path, const decoding::DirectoryFile &directory);
    void addFolder(const std::filesystem::path &folder);
    decoding::DirectoryFile directoryAt(const std::filesystem::path &path) const;

    const task::Progress &m_progress;
    std::set<std::filesystem::path> m_seen;
};

/// The files of all paths. One bad path among several is listed as skipped; the only one is
/// refused. *Throws* as `FileList::add`. *Requires*: `progress` outlives the list.
FileList listFiles(const std::vector<std::filesystem::path> &paths, const task::Progress &progress);

} // namespace pellucid::dicom
