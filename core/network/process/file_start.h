// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/network/client/query.h"

namespace pellucid::network::process {

/// What the start of a DICOM file says (PS3.10, 7.1): of class and instance what the data set says,
/// which may differ from the meta header after de-identification.
struct FileStart {
    Arrival arrival;
    std::size_t dataSet = 0; ///< where it begins, in bytes
};

/// *Returns* nothing while more bytes are needed; `isWhole`: no more bytes come. *Throws*
/// Error{unusable} if it is not such a file.
std::optional<FileStart> readFileStart(std::span<const std::byte> start, bool isWhole = false);

/// The same of a whole file. *Throws* the same.
FileStart startOf(std::span<const std::byte> file);

} // namespace pellucid::network::process
