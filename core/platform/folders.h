// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace pellucid::platform {

/// Where this program keeps a user's data that may be lost: $XDG_CACHE_HOME/pellucid or
/// ~/.cache/pellucid; on Windows %LOCALAPPDATA%\\Pellucid\\Cache in place of the latter. The folder
/// may not exist. None if the user has no such place.
std::optional<std::filesystem::path> userCachePath();
/// The same for data that must be kept: $XDG_DATA_HOME/pellucid or ~/.local/share/pellucid;
/// on Windows %LOCALAPPDATA%\\Pellucid\\Data.
std::optional<std::filesystem::path> userDataPath();

/// Makes a folder that only the user may enter. *Throws* std::system_error, also if it exists.
void makePrivateFolder(const std::filesystem::path &folder);
/// Puts a file or a folder in the place of another one, which comes to where it was. False if the
/// file system cannot do that at once.
bool exchange(const std::filesystem::path &a, const std::filesystem::path &b);

} // namespace pellucid::platform
