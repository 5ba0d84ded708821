// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/exchange/query.h"

namespace pellucid::network {

/// What the meta header of a DICOM file says, from the first bytes of the file (PS3.10, 7.1).
/// *Shape*: nothing while more bytes are needed. *Throws* Error{unusable} if it is not such a file.
std::optional<exchange::Arrival> arrivalOf(std::span<const std::byte> start);

} // namespace pellucid::network
