// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_ids.h"

#include <sys/stat.h>

namespace pellucid::files {

namespace {

std::optional<std::pair<dev_t, ino_t>> idOf(const std::filesystem::path &path) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0)
        return std::nullopt;
    return std::pair(about.st_dev, about.st_ino);
}

} // namespace

FileIds::FileIds(const std::vector<std::filesystem::path> &files) {
    for (const auto &file : files)
        if (const auto id = idOf(file))
            m_files.emplace(*id, file);
}

std::optional<std::filesystem::path> FileIds::find(const std::filesystem::path &path) const {
    const auto id = idOf(path);
    const auto it = id ? m_files.find(*id) : m_files.end();
    return it == m_files.end() ? std::nullopt : std::optional(it->second);
}

} // namespace pellucid::files
