// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/socket.h"

#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <system_error>

#include "core/platform/place.h"

namespace pellucid::platform {

ListeningSocket listenOn(const std::string &address, int port, int waiting, Accepting accepting) {
    Place place = ownPlace(address, port);
    const int type =
        SOCK_STREAM | SOCK_CLOEXEC | (accepting == Accepting::neverWaits ? SOCK_NONBLOCK : 0);
    ListeningSocket listening{Handle(::socket(place.any.sa_family, type, 0), Opened::socket)};
    const int socket = listening.socket.get(), on = 1, off = 0;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    ::setsockopt(socket, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
    socklen_t size = sizeof place;
    if (socket < 0 || ::bind(socket, &place.any, size) != 0 || ::listen(socket, waiting) != 0 ||
        ::getsockname(socket, &place.any, &size) != 0)
        throw std::system_error(errno, std::generic_category());
    listening.port = portOf(place);
    return listening;
}

bool awaitInput(HandleView socket, int milliseconds) {
    pollfd waiting{socket.get(), POLLIN, 0};
    return ::poll(&waiting, 1, milliseconds) > 0;
}

std::optional<Connected> acceptFrom(HandleView listening, Accepting accepting) {
    Place from;
    socklen_t size = sizeof from;
    const int flags = SOCK_CLOEXEC | (accepting == Accepting::neverWaits ? SOCK_NONBLOCK : 0);
    Handle socket(::accept4(listening.get(), &from.any, &size, flags), Opened::socket);
    if (!socket)
        return std::nullopt;
    return Connected{std::move(socket), textOf(from), portOf(from)};
}

Handle connectTo(const std::string &address, int port, double seconds) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICHOST; // with a scope, perhaps
    addrinfo *found = nullptr;
    if (::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0)
        throw std::system_error(EINVAL, std::generic_category());
    Handle socket(::socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0),
                  Opened::socket);
    int error = 0;
    if (!socket || ::connect(socket.get(), found->ai_addr, found->ai_addrlen) != 0)
        error = errno;
    ::freeaddrinfo(found);
    if (error == EINPROGRESS) {
        pollfd waiting{socket.get(), POLLOUT, 0};
        socklen_t size = sizeof error;
        if (::poll(&waiting, 1, int(std::lround(seconds * 1000.0))) > 0)
            ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
        else
            error = ETIMEDOUT;
    }
    if (error != 0)
        throw std::system_error(error, std::generic_category());
    sendAtOnce(socket);
    return socket;
}

void makeWaiting(HandleView socket) {
    ::fcntl(socket.get(), F_SETFL, ::fcntl(socket.get(), F_GETFL) & ~O_NONBLOCK);
}

void sendLast(HandleView socket, std::string_view bytes) {
    (void)!::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ::shutdown(socket.get(), SHUT_WR);
}

std::optional<std::size_t> receiveSome(HandleView socket, std::span<char> to) {
    const ssize_t got = ::recv(socket.get(), to.data(), to.size(), 0);
    if (got >= 0)
        return std::size_t(got);
    return errno == EINTR || errno == EAGAIN ? std::nullopt : std::optional<std::size_t>(0);
}

bool otherEndHasHungUp() {
    return errno == EPIPE || errno == ECONNRESET;
}

void sendAtOnce(HandleView socket) {
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void acknowledgeAtOnce(HandleView socket) {
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

} // namespace pellucid::platform
