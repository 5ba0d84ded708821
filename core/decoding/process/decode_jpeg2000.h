// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "core/dcmtk/encode_jpeg2000.h"
#include "core/decoding/client/instance.h"

namespace pellucid::decoding::process {

/// Decodes a codestream or JP2 file of one component. *Throws* Error{unusable}, also if it does not
/// match the data set's header.
dcmtk::Jpeg2000Image decodeJpeg2000(std::span<const std::byte> data,
                                    const InstanceHeader &expected);

} // namespace pellucid::decoding::process
