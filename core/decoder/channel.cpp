// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/channel.h"

#include <cerrno>
#include <sys/mman.h>

#include "core/decoder/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoder {

bool send(int socket, const Message &message, int descriptor) {
    return helper::sendPacket(socket, std::as_bytes(std::span(&message, 1)), {}, descriptor,
                              helper::WhenBusy::fail);
}

std::optional<Received> receive(int socket, Takes takes) {
    Received received;
    // Packets keep their boundaries: one of a different size is not a message.
    auto packet = helper::receivePacket(
        socket, std::as_writable_bytes(std::span(&received.message, 1)), {}, takes);
    if (!packet)
        return std::nullopt;
    received.descriptor = std::move(packet->descriptor);
    return received;
}

Mapping::Mapping(int fd, std::size_t bytes, Access access) {
    if (bytes == 0)
        return;
    const int may = access == Access::write ? PROT_READ | PROT_WRITE : PROT_READ;
    void *const data = ::mmap(nullptr, bytes, may, MAP_SHARED, fd, 0);
    if (data == MAP_FAILED)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::cannotBeMapped(task::systemReason(errno)));
    m_data = static_cast<std::byte *>(data);
    m_size = bytes;
}

Mapping::~Mapping() {
    if (m_data != nullptr)
        ::munmap(m_data, m_size);
}

} // namespace pellucid::decoder
