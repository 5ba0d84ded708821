// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace pellucid::files {

/// Writes a NumPy array of float32, little endian, C order. *Shape*: height x width, or height x
/// width x channels if channels > 1. The file appears only when complete. *Throws* Error{output}.
void writeNpy(const std::filesystem::path &path, std::span<const float> samples, int height,
              int width, int channels = 1);

/// Writes an opaque 8-bit RGB PNG. *Shape*: height x width x 4, RGBA, rows from the top; alpha is
/// ignored. The file appears only when complete. *Throws* Error{output}.
void writePng(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
              int width);

} // namespace pellucid::files
