// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pellucid::dcmtk {

/// One component of a JPEG 2000 image. *Shape*: rows x columns.
struct Jpeg2000Image {
    int rows = 0, columns = 0;
    int precision = 0;
    bool isSigned = false;
    std::vector<std::int32_t> samples;
    bool isDamaged = false; ///< after decoding: truncated, or the decoder warned
};

/// Encodes one component losslessly as a codestream. *Throws* Error{internal}.
std::vector<std::byte> encodeJpeg2000(const Jpeg2000Image &image);

} // namespace pellucid::dcmtk
