// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/exchange/query.h"

namespace pellucid::network {

/// What the meta header of a DICOM file says (PS3.10, 7.1), from the first bytes of the file; but
/// class and instance as the data set says, which may differ after de-identification. *Shape*:
/// nothing while more bytes are needed; `isWhole`: no more bytes come. *Throws* Error{unusable} if
/// it is not such a file.
std::optional<exchange::Arrival> arrivalOf(std::span<const std::byte> start, bool isWhole = false);

} // namespace pellucid::network
