// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/channel.h"

namespace pellucid::decoding {

bool send(int socket, const Message &message, int descriptor) {
    return confined::sendPacket(socket, std::as_bytes(std::span(&message, 1)), {}, descriptor,
                                confined::WhenBusy::fail);
}

std::optional<Received> receive(int socket, Takes takes) {
    Received received;
    // Packets keep their boundaries: one of a different size is not a message.
    auto packet = confined::receivePacket(
        socket, std::as_writable_bytes(std::span(&received.message, 1)), {}, takes);
    if (!packet)
        return std::nullopt;
    received.descriptor = std::move(packet->descriptor);
    return received;
}

} // namespace pellucid::decoding
