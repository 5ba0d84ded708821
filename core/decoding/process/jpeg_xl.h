// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/decoding/client/instance.h"

namespace pellucid::decoding::process {

/// One component of a JPEG XL image. *Shape*: rows x columns, unsigned.
struct JpegXlImage {
    int precision = 0;
    std::vector<std::uint16_t> samples;
};

/// Decodes a codestream or a container of one component. *Throws* Error{unusable}, also if it does
/// not match the data set's header.
JpegXlImage decodeJpegXl(std::span<const std::byte> data, const InstanceHeader &expected);

} // namespace pellucid::decoding::process
