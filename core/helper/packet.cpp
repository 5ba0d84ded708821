// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/helper/packet.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>

namespace pellucid::helper {

bool sendPacket(int socket, std::span<const std::byte> head, std::span<const std::byte> body,
                int descriptor, WhenBusy whenBusy) {
    // sendmsg reads the bytes, but takes no constant ones.
    std::array<iovec, 2> parts{iovec{const_cast<std::byte *>(head.data()), head.size()},
                               iovec{const_cast<std::byte *>(body.data()), body.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr packet{};
    packet.msg_iov = parts.data();
    packet.msg_iovlen = parts.size();
    if (descriptor >= 0) {
        packet.msg_control = control.data();
        packet.msg_controllen = control.size();
        cmsghdr *const c = CMSG_FIRSTHDR(&packet);
        c->cmsg_level = SOL_SOCKET;
        c->cmsg_type = SCM_RIGHTS;
        c->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(c), &descriptor, sizeof(int));
    }
    const int flags = MSG_NOSIGNAL | (whenBusy == WhenBusy::fail ? MSG_DONTWAIT : 0);
    ssize_t sent = -1;
    do
        sent = ::sendmsg(socket, &packet, flags);
    while (sent < 0 && errno == EINTR);
    return sent == ssize_t(head.size() + body.size());
}

std::optional<ReceivedPacket> receivePacket(int socket, std::span<std::byte> head,
                                            std::span<std::byte> body, Takes takes) {
    ReceivedPacket received;
    std::array<iovec, 2> parts{iovec{head.data(), head.size()}, iovec{body.data(), body.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr packet{};
    packet.msg_iov = parts.data();
    packet.msg_iovlen = parts.size();
    // Without space for a descriptor the kernel drops an attached one and reports it.
    if (takes == Takes::descriptor) {
        packet.msg_control = control.data();
        packet.msg_controllen = control.size();
    }
    ssize_t got = -1;
    do
        got = ::recvmsg(socket, &packet, MSG_CMSG_CLOEXEC);
    while (got < 0 && errno == EINTR);
    for (cmsghdr *c = got > 0 ? CMSG_FIRSTHDR(&packet) : nullptr; c != nullptr;
         c = CMSG_NXTHDR(&packet, c))
        if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SCM_RIGHTS)
            for (std::size_t at = 0; CMSG_LEN(at + sizeof(int)) <= c->cmsg_len; at += sizeof(int)) {
                int fd = -1;
                std::memcpy(&fd, CMSG_DATA(c) + at, sizeof fd);
                received.descriptor = files::Descriptor(fd); // closes the previous one
            }
    if (got < ssize_t(head.size()) || (packet.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0)
        return std::nullopt;
    received.bytes = std::size_t(got);
    return received;
}

} // namespace pellucid::helper
