// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/folders.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>

namespace pellucid::platform {

namespace {

// The place below the first of two variables that is set. The XDG specification says to ignore
// relative paths in them.
std::optional<std::filesystem::path> below(const char *xdg, const char *belowHome) {
    for (const auto &[variable, place] : {std::pair(xdg, "pellucid"), {"HOME", belowHome}})
        if (const char *const value = std::getenv(variable);
            value != nullptr && std::filesystem::path(value).is_absolute())
            return std::filesystem::path(value) / place;
    return std::nullopt;
}

} // namespace

std::optional<std::filesystem::path> userCachePath() {
    return below("XDG_CACHE_HOME", ".cache/pellucid");
}

std::optional<std::filesystem::path> userDataPath() {
    return below("XDG_DATA_HOME", ".local/share/pellucid");
}

void makePrivateFolder(const std::filesystem::path &folder) {
    if (::mkdir(folder.c_str(), 0700) != 0)
        throw std::system_error(errno, std::generic_category());
}

bool exchange(const std::filesystem::path &a, const std::filesystem::path &b) {
    return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

} // namespace pellucid::platform
