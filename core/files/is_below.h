// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>

#include "core/platform/file.h"

namespace pellucid::files {

/// Whether a path is below a folder, at any depth. Compares names as the file system does, not what
/// links resolve to.
inline bool isBelow(const std::filesystem::path &path, const std::filesystem::path &folder) {
    const auto [rest, name] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end(), platform::isSameName);
    return rest == folder.end() && name != path.end();
}

} // namespace pellucid::files
