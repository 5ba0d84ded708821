// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/decoding/client/instance.h"
#include "core/task/reason.h"

namespace pellucid::decoding::process {

/// The header of a JPEG or JPEG-LS frame (ISO/IEC 10918-1, B.2.2; 14495-1, C.2.2).
struct JpegFrame {
    int rows = 0; ///< 0: given after the first scan
    int columns = 0, components = 0, precision = 0;
    int process = 0; ///< the low byte of the marker: 0xC0 baseline, 0xC3 lossless, 0xF7 JPEG-LS ...
};

/// Empty if there is no such header.
std::optional<JpegFrame> jpegFrame(std::span<const std::byte> frame);

/// Compares a compressed frame with the data set's header. *Requires*: the header's `bitsAllocated`
/// is 8 or 16. *Throws* Error{unusable} if they differ.
void requireMatchesHeader(std::int64_t rows, std::int64_t columns, int components, int precision,
                          const InstanceHeader &expected);

/// Why a run-length frame does not unpack to exactly rows x columns samples of this many bytes
/// (PS3.5, annex G); empty if it does.
std::optional<task::Reason> whyIncompleteRle(std::span<const std::byte> frame, int rows,
                                             int columns, int bytesEach);

} // namespace pellucid::decoding::process
