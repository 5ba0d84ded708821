// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/user_folders.h"

#include <system_error>

#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/platform/folders.h"
#include "core/platform/process.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

// The same folder, created if necessary.
std::optional<std::filesystem::path> created(const std::optional<std::filesystem::path> &folder) {
    try {
        if (folder)
            createPrivateFolders(*folder);
        return folder;
    } catch (const task::Error &) {
        return std::nullopt;
    }
}

} // namespace

std::optional<std::filesystem::path> userCacheFolder() {
    return created(platform::userCachePath());
}

std::optional<std::filesystem::path> userDataFolder() {
    return created(platform::userDataPath());
}

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
    try {
        platform::makePrivateFolder(folder);
    } catch (const std::system_error &error) {
        if (!isThere())
            throw task::Error(task::ErrorCode::output,
                              task::because::cannotBeMade(task::systemReason(error.code())),
                              folder);
    }
}

std::filesystem::path programFolder() {
    return platform::programFile().parent_path();
}

} // namespace pellucid::files
