// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>

namespace pellucid::files {

/// Whether a path lies in a folder, or in a folder of it. Both are compared as they are written,
/// but for the kind of their slashes.
inline bool isBelow(const std::filesystem::path &path, const std::filesystem::path &folder) {
    const auto [rest, name] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return rest == folder.end() && name != path.end();
}

} // namespace pellucid::files
