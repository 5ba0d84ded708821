// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pellucid::parse {

/// One component of a JPEG XL image. *Shape*: rows x columns, unsigned.
struct JpegXlImage {
    int precision = 0;
    std::vector<std::uint16_t> samples;
};

/// Decodes a codestream or a container of one component of at most 16 bits.
/// *Throws* Error{unusable}, also if the image has another size.
JpegXlImage decodeJpegXl(std::span<const std::byte> data, int expectedRows, int expectedColumns);

} // namespace pellucid::parse
