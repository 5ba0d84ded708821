// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>

class DcmInputStream;

namespace pellucid::decoding::process {

/// Makes DCMTK read a file in memory like a file on disk: large values are loaded only on demand.
/// Reading *throws* Error{unusable} if sequences are nested so deeply that DCMTK's recursion would
/// use more than half of the stack.
std::unique_ptr<DcmInputStream> memoryInput(std::span<const std::byte> file);

} // namespace pellucid::decoding::process
