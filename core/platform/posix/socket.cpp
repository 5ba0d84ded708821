// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/socket.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>

namespace pellucid::platform {

namespace {

// An address and a port, of either kind.
union Place {
    sockaddr any;
    sockaddr_in at4;
    sockaddr_in6 at6;
    sockaddr_storage all{};
};

std::string textOf(const Place &place) {
    std::array<char, NI_MAXHOST> text{};
    const in6_addr &at = place.at6.sin6_addr;
    constexpr std::size_t mappedAt = 12; // bytes
    if (place.any.sa_family == AF_INET)
        ::inet_ntop(AF_INET, &place.at4.sin_addr, text.data(), text.size());
    else if (IN6_IS_ADDR_V4MAPPED(&at))
        ::inet_ntop(AF_INET, at.s6_addr + mappedAt, text.data(), text.size());
    else // with its scope, if it has one
        ::getnameinfo(&place.any, sizeof place.at6, text.data(), text.size(), nullptr, 0,
                      NI_NUMERICHOST);
    return text.data();
}

int portOf(const Place &place) {
    return ntohs(place.any.sa_family == AF_INET6 ? place.at6.sin6_port : place.at4.sin_port);
}

std::optional<Place> placeIn(const std::string &text) {
    Place place;
    if (::inet_pton(AF_INET, text.c_str(), &place.at4.sin_addr) == 1)
        place.any.sa_family = AF_INET;
    else if (::inet_pton(AF_INET6, text.c_str(), &place.at6.sin6_addr) == 1)
        place.any.sa_family = AF_INET6;
    else
        return std::nullopt;
    return place;
}

// An address of this computer to listen on; empty: all of them.
Place ownPlace(const std::string &address, int port) {
    Place place;
    if (address.empty()) // IPv6 may be switched off
        place.any.sa_family =
            Handle(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0)) ? AF_INET6 : AF_INET;
    else if (const auto given = placeIn(address))
        place = *given;
    else
        throw std::system_error(EINVAL, std::generic_category());
    if (place.any.sa_family == AF_INET6) {
        place.at6.sin6_port = htons(std::uint16_t(port));
        return place;
    }
    place.at4.sin_port = htons(std::uint16_t(port));
    // Linux binds a port to the address of broadcasts, which nobody can connect to.
    if (place.at4.sin_addr.s_addr == INADDR_BROADCAST)
        throw std::system_error(EINVAL, std::generic_category());
    return place;
}

} // namespace

std::optional<AddressKind> addressKind(const std::string &text) {
    const auto place = placeIn(text);
    if (!place)
        return std::nullopt;
    return place->any.sa_family == AF_INET ? AddressKind::ipv4 : AddressKind::ipv6;
}

bool isLoopback(const std::string &address) {
    constexpr std::uint32_t loopback = 127;
    const auto place = placeIn(address);
    if (!place)
        return false;
    return place->any.sa_family == AF_INET ? ntohl(place->at4.sin_addr.s_addr) >> 24 == loopback
                                           : bool(IN6_IS_ADDR_LOOPBACK(&place->at6.sin6_addr));
}

std::vector<std::string> addressesOf(const std::string &host) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo *found = nullptr;
    std::vector<std::string> addresses;
    if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0)
        return addresses;
    for (const addrinfo *each = found; each != nullptr; each = each->ai_next) {
        Place place;
        std::memcpy(&place.all, each->ai_addr,
                    std::min<std::size_t>(each->ai_addrlen, sizeof place.all));
        addresses.push_back(textOf(place));
    }
    ::freeaddrinfo(found);
    return addresses;
}

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

std::string addressText(std::span<const unsigned char> bytes) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (bytes.size() == 4 || bytes.size() == 16)
        ::inet_ntop(bytes.size() == 4 ? AF_INET : AF_INET6, bytes.data(), text.data(), text.size());
    return text.data();
}

} // namespace pellucid::platform
