// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <string>

#include <fmt/format.h>

#include "core/files/atomic_file.h"
#include "core/files/image_files.h"

namespace pellucid::files {

void writeNpy(const std::filesystem::path &path, std::span<const float> samples, int height,
              int width, int channels) {
    assert(samples.size() == std::size_t(height) * width * channels);
    std::string header =
        fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': {}, }}",
                    channels == 1 ? fmt::format("({}, {})", height, width)
                                  : fmt::format("({}, {}, {})", height, width, channels));
    // Magic, version and length take 10 bytes; the format requires the data at a multiple of 64.
    header.append(63 - (10 + header.size()) % 64, ' ');
    header.push_back('\n');
    const std::string start = std::string("\x93NUMPY\x01\x00", 8) + char(header.size() & 0xFF) +
                              char(header.size() >> 8) + header;
    AtomicFile file(path);
    file.write(start);
    file.write(std::as_bytes(samples));
    file.commit();
}

} // namespace pellucid::files
