// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <functional>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files/image_files.h"

namespace pellucid::files {

NpyFile::NpyFile(const std::filesystem::path &path, const std::vector<std::size_t> &shape)
    : m_file(path),
      m_missing(std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>())) {
    std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}",
                                     fmt::join(shape, ", "));
    // Magic, version and length take 10 bytes; the format requires the data at a multiple of 64.
    header.append(63 - (10 + header.size()) % 64, ' ');
    header.push_back('\n');
    m_file.write(std::string("\x93NUMPY\x01\x00", 8) + char(header.size() & 0xFF) +
                 char(header.size() >> 8) + header);
}

void NpyFile::write(std::span<const float> samples) {
    assert(samples.size() <= m_missing);
    m_missing -= samples.size();
    m_file.write(std::as_bytes(samples));
}

void NpyFile::commit() {
    assert(m_missing == 0);
    m_file.commit();
}

void writeNpy(const std::filesystem::path &path, std::span<const float> samples, int height,
              int width, int channels) {
    assert(samples.size() == std::size_t(height) * width * channels);
    std::vector<std::size_t> shape{std::size_t(height), std::size_t(width)};
    if (channels > 1)
        shape.push_back(std::size_t(channels));
    NpyFile file(path, shape);
    file.write(samples);
    file.commit();
}

} // namespace pellucid::files
