// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/connect.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

#include "core/network/client/reasons.h"
#include "core/network/process/association.h"
#include "core/network/process/reasons.h"

namespace {

int connectedBefore = -1; // see useAtNextConnect

} // namespace

// The linker puts this function in place of libc's. libcurl 7.88 connects even a socket that it is
// told is connected; in this process that call is forbidden by then, so it is answered here.
extern "C" int connect(int socket, const sockaddr *address, socklen_t size) {
    if (const int given = std::exchange(connectedBefore, -1); given >= 0) {
        const int result = ::dup2(given, socket);
        ::close(given);
        return result < 0 ? -1 : 0;
    }
    sockaddr_storage peer{};
    socklen_t peerSize = sizeof peer;
    if (::getpeername(socket, reinterpret_cast<sockaddr *>(&peer), &peerSize) == 0)
        return 0;
    return int(::syscall(SYS_connect, socket, address, size));
}

namespace pellucid::network::process {

namespace {

namespace because = task::because;

// Connects within the time; -1 with `errno`.
int connectWithin(const addrinfo &address, double seconds) {
    const int socket = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0)
        return -1;
    int error = 0;
    if (::connect(socket, address.ai_addr, address.ai_addrlen) != 0) {
        error = errno;
        pollfd waiting{socket, POLLOUT, 0};
        if (error == EINPROGRESS && ::poll(&waiting, 1, int(std::lround(seconds * 1000.0))) > 0) {
            socklen_t size = sizeof error;
            ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
        } else if (error == EINPROGRESS) {
            error = ETIMEDOUT;
        }
    }
    if (error == 0) {
        const int on = 1;
        ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return socket;
    }
    ::close(socket);
    errno = error;
    return -1;
}

} // namespace

Connected connectTo(const Peer &peer, Control &control) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo *found = nullptr;
    const std::string port = std::to_string(peer.port);
    if (::getaddrinfo(peer.host.c_str(), port.c_str(), &wanted, &found) != 0)
        throw Lost{because::hostIsUnknown(peer.host)};
    Connected connected;
    int error = 0;
    for (const addrinfo *each = found; each != nullptr && connected.socket < 0;
         each = each->ai_next) {
        std::array<char, INET6_ADDRSTRLEN> text{};
        ::getnameinfo(each->ai_addr, each->ai_addrlen, text.data(), text.size(), nullptr, 0,
                      NI_NUMERICHOST);
        if (connected.address.empty())
            control.step(Step::name, text.data());
        connected.address = text.data();
        connected.socket = connectWithin(*each, peer.connectSeconds);
        error = errno;
    }
    ::freeaddrinfo(found);
    if (connected.socket >= 0)
        return connected;
    if (error == ECONNREFUSED)
        throw Lost{because::connectionIsRefused};
    if (error == ETIMEDOUT)
        throw Lost{because::hostDoesNotAnswer};
    throw Lost{because::cannotConnect(task::systemReason(error))};
}

void useAtNextConnect(int socket) {
    connectedBefore = socket;
}

} // namespace pellucid::network::process
