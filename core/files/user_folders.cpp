// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/user_folders.h"

#include <cstdlib>
#include <initializer_list>
#include <system_error>

namespace pellucid::files {

namespace {

struct Candidate {
    const char *variable, *below;
};

// The folder below the first variable that is set.
std::optional<std::filesystem::path> folderBelow(std::initializer_list<Candidate> candidates) {
    std::filesystem::path folder;
    for (const auto &[variable, below] : candidates) {
        const char *const value = std::getenv(variable);
        // The XDG specification says to ignore relative paths in these variables.
        if (folder.empty() && value != nullptr && std::filesystem::path(value).is_absolute())
            folder = std::filesystem::path(value) / below;
    }
    std::error_code failed, ignored;
    if (folder.empty())
        return std::nullopt;
    const bool isNew = std::filesystem::create_directories(folder, failed);
    if (failed)
        return std::nullopt;
    if (isNew) // patients' names are private
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, ignored);
    return folder;
}

} // namespace

#ifdef _WIN32
std::optional<std::filesystem::path> userCacheFolder() {
    return folderBelow({{"LOCALAPPDATA", "pellucid/cache"}});
}
std::optional<std::filesystem::path> userDataFolder() {
    return folderBelow({{"APPDATA", "pellucid"}});
}
#else
std::optional<std::filesystem::path> userCacheFolder() {
    return folderBelow({{"XDG_CACHE_HOME", "pellucid"}, {"HOME", ".cache/pellucid"}});
}
std::optional<std::filesystem::path> userDataFolder() {
    return folderBelow({{"XDG_DATA_HOME", "pellucid"}, {"HOME", ".local/share/pellucid"}});
}
#endif

std::filesystem::path programFolder() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

} // namespace pellucid::files
