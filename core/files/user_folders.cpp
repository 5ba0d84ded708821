// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/user_folders.h"

#include <cerrno>
#include <cstdlib>
#include <initializer_list>
#include <sys/stat.h>
#include <system_error>

#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

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
    if (folder.empty())
        return std::nullopt;
    try {
        createPrivateFolders(folder);
    } catch (const task::Error &) {
        return std::nullopt;
    }
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

void createPrivateFolders(const std::filesystem::path &folder) {
    std::error_code unknown;
    if (folder.empty() || folder == folder.root_path())
        return;
    createPrivateFolders(folder.parent_path());
    if (!folder.has_filename()) // a slash at the end
        return;
    const auto isThere = [&] {
        if (std::filesystem::is_symlink(folder, unknown))
            requireTrusted(folder);
        return std::filesystem::is_directory(folder, unknown);
    };
    if (isThere())
        return;
    const int error = ::mkdir(folder.c_str(), 0700) == 0 ? 0 : errno;
    if (error != 0 && !isThere())
        throw task::Error(task::ErrorCode::output,
                          task::because::cannotBeMade(task::systemReason(error)), folder);
}

std::filesystem::path programFolder() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

} // namespace pellucid::files
