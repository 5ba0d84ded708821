// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace pellucid::fuzz {

// What crosses the border between the program and `pellucid-net`, in both directions.
void packing(std::span<const std::byte> bytes);
void networkMessage(std::span<const std::byte> bytes);
void packet(std::span<const std::byte> bytes);
void control(std::span<const std::byte> bytes);

// What `pellucid-net` parses itself.
/// The first line is the content type.
void multipart(std::span<const std::byte> bytes);
void dicomJson(std::span<const std::byte> bytes);
void fileStart(std::span<const std::byte> bytes);

} // namespace pellucid::fuzz
