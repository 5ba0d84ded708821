// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "core/platform/file.h"

namespace pellucid::files {

/// Files identified by what they are, because a file has many paths through links of either kind.
class FileIds {
public:
    /// Ignores files that do not exist.
    explicit FileIds(const std::vector<std::filesystem::path> &files);
    bool isEmpty() const { return m_files.empty(); }
    /// The file among them that a path refers to.
    std::optional<std::filesystem::path> find(const std::filesystem::path &path) const;

private:
    std::map<platform::FileId, std::filesystem::path> m_files;
};

} // namespace pellucid::files
