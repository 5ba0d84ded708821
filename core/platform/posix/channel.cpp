// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/channel.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <system_error>

namespace pellucid::platform {

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

struct Channel::Reading {};

Channel::Channel(Handle end) : m_end(std::move(end)) {}

Channel::~Channel() = default;

Channel &Channel::operator=(Channel &&other) noexcept = default;

bool Channel::send(std::span<const std::byte> head, std::span<const std::byte> body,
                   HandleView handle, WhenBusy whenBusy) const {
    std::string bytes(reinterpret_cast<const char *>(head.data()), head.size());
    bytes.append(reinterpret_cast<const char *>(body.data()), body.size());
    const int flags = MSG_NOSIGNAL | (whenBusy == WhenBusy::fail ? MSG_DONTWAIT : 0);
    ssize_t sent = -1;
    do // helpers, which send no handle, may not call sendmsg
        sent = handle ? sendWith(handle.get(), m_end.get(), bytes, flags)
                      : ::send(m_end.get(), bytes.data(), bytes.size(), flags);
    while (sent < 0 && errno == EINTR);
    return sent == ssize_t(bytes.size());
}

std::optional<ReceivedPacket> Channel::receive(std::span<std::byte> head, std::span<std::byte> body,
                                               Takes takes) const {
    ReceivedPacket received;
    std::array<iovec, 2> parts{iovec{head.data(), head.size()}, iovec{body.data(), body.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr packet{};
    packet.msg_iov = parts.data();
    packet.msg_iovlen = parts.size();
    // Without space for a descriptor the kernel drops an attached one and reports it.
    if (takes == Takes::handle) {
        packet.msg_control = control.data();
        packet.msg_controllen = control.size();
    }
    ssize_t got = -1;
    do
        got = ::recvmsg(m_end.get(), &packet, MSG_CMSG_CLOEXEC);
    while (got < 0 && errno == EINTR);
    for (cmsghdr *c = got > 0 ? CMSG_FIRSTHDR(&packet) : nullptr; c != nullptr;
         c = CMSG_NXTHDR(&packet, c))
        if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SCM_RIGHTS)
            for (std::size_t at = 0; CMSG_LEN(at + sizeof(int)) <= c->cmsg_len; at += sizeof(int)) {
                int fd = -1;
                std::memcpy(&fd, CMSG_DATA(c) + at, sizeof fd);
                received.handle = Handle(fd); // closes the previous one
            }
    if (got < ssize_t(head.size()) || (packet.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0)
        return std::nullopt;
    received.bytes = std::size_t(got);
    return received;
}

bool Channel::awaitPacket(int milliseconds) const {
    pollfd waiting{m_end.get(), POLLIN, 0};
    return ::poll(&waiting, 1, milliseconds) > 0;
}

std::pair<Channel, Channel> makeChannel() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw std::system_error(errno, std::generic_category());
    return {Channel(Handle(ends[0])), Channel(Handle(ends[1]))};
}

std::vector<bool> awaitAny(const Channel &channel, std::span<const HandleView> sockets,
                           int milliseconds) {
    std::vector<pollfd> waiting{{channel.end().get(), POLLIN, 0}};
    for (const HandleView &socket : sockets)
        waiting.push_back({socket.get(), POLLIN, 0});
    const bool isAny = ::poll(waiting.data(), waiting.size(), milliseconds) > 0;
    std::vector<bool> ready;
    for (const pollfd &each : waiting)
        ready.push_back(isAny && each.revents != 0);
    return ready;
}

} // namespace pellucid::platform
