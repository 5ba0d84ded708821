// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pellucid::files {

/// Larger presets and scenes are none.
inline constexpr std::size_t mostOfPreset = std::size_t(1) << 20;

/// All bytes of a file. *Throws* Error{unusable} with path and reason if it is no regular file,
/// cannot be read or holds more than `most` bytes.
std::string readText(const std::filesystem::path &path, std::size_t most);

} // namespace pellucid::files
