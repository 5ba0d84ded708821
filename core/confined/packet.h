// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/platform/handle.h"

namespace pellucid::confined {

enum class WhenBusy { wait, fail };

/// Sends a packet, a head and a body, and a descriptor unless it is -1. False if the other end is
/// closed or, with `WhenBusy::fail`, does not read.
bool sendPacket(int socket, std::span<const std::byte> head, std::span<const std::byte> body,
                int descriptor, WhenBusy whenBusy);

enum class Takes { descriptor, noDescriptors };

struct ReceivedPacket {
    std::size_t bytes = 0; ///< of the head and the body
    platform::Handle descriptor;
};

/// Waits for a packet and fills the head, then the body. Empty if the other end is closed, or the
/// packet is shorter than the head or longer than both.
std::optional<ReceivedPacket> receivePacket(int socket, std::span<std::byte> head,
                                            std::span<std::byte> body, Takes takes);

} // namespace pellucid::confined
