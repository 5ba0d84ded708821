// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace pellucid::files {

/// The user's folder for what may be lost: $XDG_CACHE_HOME/pellucid or ~/.cache/pellucid, made if
/// it is not there; on Windows below %LOCALAPPDATA%. Empty if there is no such place.
std::optional<std::filesystem::path> userCacheFolder();

/// The user's folder for what must be kept: $XDG_DATA_HOME/pellucid or ~/.local/share/pellucid; on
/// Windows below %APPDATA%. Made if it is not there. Empty if there is no such place.
std::optional<std::filesystem::path> userDataFolder();

/// Where the running program's file is; empty if that is not known.
std::filesystem::path programFolder();

} // namespace pellucid::files
