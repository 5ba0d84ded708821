// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace pellucid::files {

/// The user's folder for what may be lost: $XDG_CACHE_HOME/pellucid or ~/.cache/pellucid, made if
/// it is not there; on Windows below %LOCALAPPDATA%. Empty if there is no such place.
std::optional<std::filesystem::path> userCacheFolder();

} // namespace pellucid::files
