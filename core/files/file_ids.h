// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace pellucid::files {

/// Files by what the system knows them by: a file has many paths, through links of either kind.
class FileIds {
public:
    /// Those that are there.
    explicit FileIds(const std::vector<std::filesystem::path> &files);
    bool isEmpty() const { return m_files.empty(); }
    /// The one of them that a path leads to.
    std::optional<std::filesystem::path> find(const std::filesystem::path &path) const;

private:
    std::map<std::pair<dev_t, ino_t>, std::filesystem::path> m_files;
};

} // namespace pellucid::files
