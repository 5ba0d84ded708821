// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pellucid::files {

/// Larger files are not presets or scenes.
inline constexpr std::size_t maxPresetBytes = std::size_t(1) << 20;
/// Scenes and sessions contain hours of work by hand, and sessions name each file of a study.
inline constexpr std::size_t maxSceneBytes = std::size_t(64) << 20;

/// All bytes of a file. *Throws* Error{unusable} with path and reason if it is not a regular file,
/// cannot be read or has more than `maxBytes` bytes.
std::string readText(const std::filesystem::path &path, std::size_t maxBytes);

} // namespace pellucid::files
