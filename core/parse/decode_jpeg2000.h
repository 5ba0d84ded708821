// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "core/dcmtk/encode_jpeg2000.h"

namespace pellucid::parse {

/// Decodes a codestream or JP2 file of one component of at most 16 bits.
/// *Throws* Error{unusable}.
dcmtk::Jpeg2000Image decodeJpeg2000(std::span<const std::byte> data, int expectedRows,
                                    int expectedColumns);

} // namespace pellucid::parse
