// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/socket.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <netdb.h>
#include <netinet/in.h>
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
    std::array<char, INET6_ADDRSTRLEN> text{};
    const in6_addr &at = place.at6.sin6_addr;
    constexpr std::size_t mappedAt = 12; // bytes
    if (place.any.sa_family == AF_INET)
        ::inet_ntop(AF_INET, &place.at4.sin_addr, text.data(), text.size());
    else if (IN6_IS_ADDR_V4MAPPED(&at))
        ::inet_ntop(AF_INET, at.s6_addr + mappedAt, text.data(), text.size());
    else
        ::inet_ntop(AF_INET6, &at, text.data(), text.size());
    return text.data();
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
    ListeningSocket listening{Handle(::socket(place.any.sa_family, type, 0))};
    const int socket = listening.socket.get(), on = 1, off = 0;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    ::setsockopt(socket, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
    socklen_t size = sizeof place;
    if (socket < 0 || ::bind(socket, &place.any, size) != 0 || ::listen(socket, waiting) != 0 ||
        ::getsockname(socket, &place.any, &size) != 0)
        throw std::system_error(errno, std::generic_category());
    listening.port =
        ntohs(place.any.sa_family == AF_INET6 ? place.at6.sin6_port : place.at4.sin_port);
    return listening;
}

bool awaitInput(const Handle &socket, int milliseconds) {
    pollfd waiting{socket.get(), POLLIN, 0};
    return ::poll(&waiting, 1, milliseconds) > 0;
}

std::optional<Connected> acceptFrom(const Handle &listening) {
    Place from;
    socklen_t size = sizeof from;
    Handle socket(::accept4(listening.get(), &from.any, &size, SOCK_CLOEXEC));
    if (!socket)
        return std::nullopt;
    return Connected{std::move(socket), textOf(from)};
}

} // namespace pellucid::platform
