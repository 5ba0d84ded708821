// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/channel.h"

namespace pellucid::decoding {

bool send(const Channel &channel, const Message &message, HandleView handle) {
    return channel.send(std::as_bytes(std::span(&message, 1)), {}, handle,
                        platform::WhenBusy::fail);
}

std::optional<Received> receive(const Channel &channel, Takes takes) {
    Received received;
    // Packets keep their boundaries: one of a different size is not a message.
    auto packet =
        channel.receive(std::as_writable_bytes(std::span(&received.message, 1)), {}, takes);
    if (!packet)
        return std::nullopt;
    received.handle = std::move(packet->handle);
    return received;
}

} // namespace pellucid::decoding
