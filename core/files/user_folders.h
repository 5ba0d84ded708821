// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace pellucid::files {

/// The user's folder for data that may be lost, see `platform::userCachePath`. Created if
/// necessary. Empty if there is no such location.
std::optional<std::filesystem::path> userCacheFolder();

/// The user's folder for data that must be kept, see `platform::userDataPath`. Created if
/// necessary. Empty if there is no such location.
std::optional<std::filesystem::path> userDataFolder();

/// Creates a folder, and those above it that are missing, for the user alone. *Throws*
/// Error{output}.
void createPrivateFolders(const std::filesystem::path &folder);

/// The folder of the running program; empty if unknown.
std::filesystem::path programFolder();

} // namespace pellucid::files
