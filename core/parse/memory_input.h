// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>

class DcmInputStream;

namespace pellucid::parse {

/// A file in memory as DCMTK reads files: large values stay where they are until they are wanted.
/// Reading *throws* Error{unusable} where sequences lie in each other deeper than half of the stack
/// allows: DCMTK descends into each.
std::unique_ptr<DcmInputStream> memoryInput(std::span<const std::byte> file);

} // namespace pellucid::parse
