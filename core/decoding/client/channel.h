// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/decoding/client/message.h"
#include "core/platform/channel.h"

namespace pellucid::decoding {

using platform::Channel, platform::Handle, platform::HandleView, platform::Takes;

/// Sends a message, and a handle if there is one; never blocks. False if the other end is closed or
/// does not read.
bool send(const Channel &channel, const Message &message, HandleView handle = {});

/// Waits for a message. Empty if the other end is closed, or sent something else.
struct Received {
    Message message;
    Handle handle;
};
std::optional<Received> receive(const Channel &channel, Takes takes);

} // namespace pellucid::decoding
