// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/channel.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <sys/mman.h>
#include <sys/socket.h>

#include "core/task/error.h"

namespace pellucid::decoder {

bool send(int socket, const Message &message, int descriptor) {
    Message copy = message;
    iovec part{&copy, sizeof copy};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    if (descriptor >= 0) {
        header.msg_control = control.data();
        header.msg_controllen = control.size();
        cmsghdr *const c = CMSG_FIRSTHDR(&header);
        c->cmsg_level = SOL_SOCKET;
        c->cmsg_type = SCM_RIGHTS;
        c->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(c), &descriptor, sizeof(int));
    }
    ssize_t sent = -1;
    do
        sent = ::sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT);
    while (sent < 0 && errno == EINTR);
    return sent == ssize_t(sizeof copy);
}

std::optional<Received> receive(int socket, Takes takes) {
    Received received;
    iovec part{&received.message, sizeof received.message};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    // Without space for a descriptor the kernel drops an attached one and reports it.
    if (takes == Takes::descriptor) {
        header.msg_control = control.data();
        header.msg_controllen = control.size();
    }
    ssize_t got = -1;
    do
        got = ::recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
    while (got < 0 && errno == EINTR);
    for (cmsghdr *c = got > 0 ? CMSG_FIRSTHDR(&header) : nullptr; c != nullptr;
         c = CMSG_NXTHDR(&header, c))
        if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SCM_RIGHTS)
            for (std::size_t at = 0; CMSG_LEN(at + sizeof(int)) <= c->cmsg_len; at += sizeof(int)) {
                int fd = -1;
                std::memcpy(&fd, CMSG_DATA(c) + at, sizeof fd);
                received.descriptor = Descriptor(fd); // closes the previous one
            }
    // Packets keep their boundaries: one of a different size is not a message.
    if (got != ssize_t(sizeof(Message)) || (header.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0)
        return std::nullopt;
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
