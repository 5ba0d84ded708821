// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/files/atomic_file.h"

namespace pellucid::files {

/// Writes a NumPy array of float32, little endian, C order. *Shape*: height x width, or height x
/// width x channels if channels > 1. The file appears only when complete. *Throws* Error{output}.
void writeNpy(const std::filesystem::path &path, std::span<const float> samples, int height,
              int width, int channels = 1);

/// The same array, written in parts, for those that do not fit in memory.
class NpyFile {
public:
    /// *Shape*: `shape`: from the slowest axis to the fastest, two or more. *Throws* Error{output}.
    NpyFile(const std::filesystem::path &path, const std::vector<std::size_t> &shape);
    /// *Throws* Error{output}.
    void write(std::span<const float> samples);
    /// *Requires*: all samples are written. *Throws* Error{output}.
    void commit();

private:
    AtomicFile m_file;
    std::size_t m_missing; ///< samples
};

/// Writes a grey PNG of 16 bits. *Shape*: height x width, rows from the top. The file appears only
/// when complete. *Throws* Error{output}.
void writePng16(const std::filesystem::path &path, std::span<const std::uint16_t> grey, int height,
                int width);

/// Writes an opaque 8-bit PNG: grey if every pixel is grey, otherwise RGB. *Shape*: height x width
/// x 4, RGBA, rows from the top; alpha is ignored. The file appears only when complete. *Throws*
/// Error{output}.
void writePng(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
              int width);

} // namespace pellucid::files
