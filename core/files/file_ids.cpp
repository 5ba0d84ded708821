// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_ids.h"

namespace pellucid::files {

FileIds::FileIds(const std::vector<std::filesystem::path> &files) {
    for (const auto &file : files)
        if (const auto id = platform::fileIdOf(file))
            m_files.emplace(*id, file);
}

std::optional<std::filesystem::path> FileIds::find(const std::filesystem::path &path) const {
    const auto id = platform::fileIdOf(path);
    const auto it = id ? m_files.find(*id) : m_files.end();
    return it == m_files.end() ? std::nullopt : std::optional(it->second);
}

} // namespace pellucid::files
