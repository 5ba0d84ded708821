// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/place.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "core/platform/socket.h"

namespace pellucid::platform {

namespace {

bool hasIpv6() {
    useSockets();
    return bool(Handle(Native(::socket(AF_INET6, SOCK_STREAM, 0)), Opened::socket));
}

} // namespace

std::string textOf(const Place &place) {
    std::array<char, NI_MAXHOST> text{};
    const in6_addr &at = place.at6.sin6_addr;
    constexpr std::size_t mappedAt = 12; // bytes
    if (place.any.sa_family == AF_INET)
        ::inet_ntop(AF_INET, &place.at4.sin_addr, text.data(), text.size());
    else if (IN6_IS_ADDR_V4MAPPED(&at))
        ::inet_ntop(AF_INET, at.s6_addr + mappedAt, text.data(), text.size());
    else // with its scope, if it has one
        ::getnameinfo(&place.any, sizeof place.at6, text.data(), decltype(NI_MAXHOST)(text.size()),
                      nullptr, 0, NI_NUMERICHOST);
    return text.data();
}

int portOf(const Place &place) {
    return ntohs(place.any.sa_family == AF_INET6 ? place.at6.sin6_port : place.at4.sin_port);
}

std::optional<Place> placeIn(const std::string &text) {
    useSockets();
    Place place;
    if (::inet_pton(AF_INET, text.c_str(), &place.at4.sin_addr) == 1)
        place.any.sa_family = AF_INET;
    else if (::inet_pton(AF_INET6, text.c_str(), &place.at6.sin6_addr) == 1)
        place.any.sa_family = AF_INET6;
    else
        return std::nullopt;
    return place;
}

Place ownPlace(const std::string &address, int port) {
    Place place;
    if (address.empty()) // IPv6 may be switched off
        place.any.sa_family = hasIpv6() ? AF_INET6 : AF_INET;
    else if (const auto given = placeIn(address))
        place = *given;
    else
        throw std::system_error(std::make_error_code(std::errc::invalid_argument));
    if (place.any.sa_family == AF_INET6) {
        place.at6.sin6_port = htons(std::uint16_t(port));
        return place;
    }
    place.at4.sin_port = htons(std::uint16_t(port));
    // Linux binds a port to the address of broadcasts, which nobody can connect to.
    if (place.at4.sin_addr.s_addr == INADDR_BROADCAST)
        throw std::system_error(std::make_error_code(std::errc::invalid_argument));
    return place;
}

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
    useSockets();
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

std::string addressText(std::span<const unsigned char> bytes) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (bytes.size() == 4 || bytes.size() == 16)
        ::inet_ntop(bytes.size() == 4 ? AF_INET : AF_INET6, bytes.data(), text.data(), text.size());
    return text.data();
}

} // namespace pellucid::platform
