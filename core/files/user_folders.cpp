// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/user_folders.h"

#include <cstdlib>
#include <system_error>

namespace pellucid::files {

std::optional<std::filesystem::path> userCacheFolder() {
    std::filesystem::path folder;
    const auto take = [&](const char *variable, const char *below) {
        const char *const value = std::getenv(variable);
        // Relative paths in these variables are to be ignored, says the standard that defines them.
        if (folder.empty() && value != nullptr && std::filesystem::path(value).is_absolute())
            folder = std::filesystem::path(value) / below;
    };
#ifdef _WIN32
    take("LOCALAPPDATA", "pellucid/cache");
#else
    take("XDG_CACHE_HOME", "pellucid");
    take("HOME", ".cache/pellucid");
#endif
    std::error_code failed;
    if (folder.empty() || (std::filesystem::create_directories(folder, failed), failed))
        return std::nullopt;
    return folder;
}

} // namespace pellucid::files
