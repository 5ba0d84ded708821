// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/confined/packet.h"
#include "core/decoding/client/message.h"
#include "core/platform/handle.h"

namespace pellucid::decoding {

using platform::Handle;

/// Sends a message, and a descriptor unless it is -1; never blocks. False if the other end is
/// closed or does not read.
bool send(int socket, const Message &message, int descriptor = -1);

/// Waits for a message. Empty if the other end is closed, or sent something else.
struct Received {
    Message message;
    Handle descriptor;
};
using confined::Takes;
std::optional<Received> receive(int socket, Takes takes);

} // namespace pellucid::decoding
