// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confined/packet.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <sys/socket.h>

namespace pellucid::confined {

namespace {

ssize_t sendWith(int descriptor, int socket, std::string &bytes, int flags) {
    iovec part{bytes.data(), bytes.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr packet{};
    packet.msg_iov = &part;
    packet.msg_iovlen = 1;
    packet.msg_control = control.data();
    packet.msg_controllen = control.size();
    cmsghdr *const c = CMSG_FIRSTHDR(&packet);
    c->cmsg_level = SOL_SOCKET;
    c->cmsg_type = SCM_RIGHTS;
    c->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(c), &descriptor, sizeof(int));
    return ::sendmsg(socket, &packet, flags);
}

} // namespace

bool sendPacket(int socket, std::span<const std::byte> head, std::span<const std::byte> body,
                int descriptor, WhenBusy whenBusy) {
    std::string bytes(reinterpret_cast<const char *>(head.data()), head.size());
    bytes.append(reinterpret_cast<const char *>(body.data()), body.size());
    const int flags = MSG_NOSIGNAL | (whenBusy == WhenBusy::fail ? MSG_DONTWAIT : 0);
    ssize_t sent = -1;
    do // helpers, which send no descriptor, may not call sendmsg
        sent = descriptor >= 0 ? sendWith(descriptor, socket, bytes, flags)
                               : ::send(socket, bytes.data(), bytes.size(), flags);
    while (sent < 0 && errno == EINTR);
    return sent == ssize_t(bytes.size());
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
                received.descriptor = platform::Handle(fd); // closes the previous one
            }
    if (got < ssize_t(head.size()) || (packet.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0)
        return std::nullopt;
    received.bytes = std::size_t(got);
    return received;
}

} // namespace pellucid::confined
