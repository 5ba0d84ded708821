// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/peer.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstring>
#include <netdb.h>
#include <netinet/in.h>

#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::network {

bool isPrivate(const Peer &peer) {
    constexpr std::uint32_t loopback = 127; // 127.0.0.0/8 (RFC 1122, 3.2.1.3)
    in_addr address{};
    in6_addr address6{};
    return peer.usesTls || peer.host == "localhost" ||
           (::inet_pton(AF_INET, peer.host.c_str(), &address) == 1 &&
            ntohl(address.s_addr) >> 24 == loopback) ||
           (::inet_pton(AF_INET6, peer.host.c_str(), &address6) == 1 &&
            IN6_IS_ADDR_LOOPBACK(&address6));
}

bool hasInsecureLogin(const Peer &peer) {
    return peer.authentication != Authentication::none && !peer.allowsInsecureLogin &&
           !isPrivate(peer);
}

void requireSecureLogin(const Peer &peer) {
    if (hasInsecureLogin(peer))
        throw task::Error(task::ErrorCode::usage, task::because::loginCanBeRead);
}

const std::vector<std::string> &transferSyntaxes() {
    static const std::vector<std::string> syntaxes{
        "1.2.840.10008.1.2.1",    // explicit VR little endian
        "1.2.840.10008.1.2",      // implicit VR little endian
        "1.2.840.10008.1.2.4.80", // JPEG-LS, lossless
        "1.2.840.10008.1.2.4.90", // JPEG 2000, lossless
        "1.2.840.10008.1.2.4.70", // JPEG, lossless, selection value 1
        "1.2.840.10008.1.2.5",    // run lengths
        "1.2.840.10008.1.2.4.91", // JPEG 2000
        "1.2.840.10008.1.2.4.81", // JPEG-LS, near-lossless
        "1.2.840.10008.1.2.4.57", // JPEG, lossless
        "1.2.840.10008.1.2.4.51", // JPEG, extended
        "1.2.840.10008.1.2.4.50", // JPEG, baseline
        "1.2.840.10008.1.2.1.99", // deflated
        "1.2.840.10008.1.2.2",    // explicit VR big endian
    };
    return syntaxes;
}

std::string hostPart(const std::string &host) {
    return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

std::string textOf(const sockaddr_storage &address) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (address.ss_family == AF_INET) {
        const auto &at = reinterpret_cast<const sockaddr_in &>(address);
        ::inet_ntop(AF_INET, &at.sin_addr, text.data(), text.size());
        return text.data();
    }
    const in6_addr &at = reinterpret_cast<const sockaddr_in6 &>(address).sin6_addr;
    constexpr std::size_t mappedAt = 12; // bytes
    if (IN6_IS_ADDR_V4MAPPED(&at))
        ::inet_ntop(AF_INET, at.s6_addr + mappedAt, text.data(), text.size());
    else
        ::inet_ntop(AF_INET6, &at, text.data(), text.size());
    return text.data();
}

std::vector<std::string> addressesOf(const std::string &host) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo *found = nullptr;
    std::vector<std::string> addresses;
    if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0)
        return addresses;
    for (const addrinfo *each = found; each != nullptr; each = each->ai_next) {
        sockaddr_storage at{};
        std::memcpy(&at, each->ai_addr, std::min<std::size_t>(each->ai_addrlen, sizeof at));
        addresses.push_back(textOf(at));
    }
    ::freeaddrinfo(found);
    return addresses;
}

const std::vector<std::string> &commonClasses() {
    static const std::vector<std::string> classes{
        "1.2.840.10008.5.1.4.1.1.2",     // CT
        "1.2.840.10008.5.1.4.1.1.4",     // MR
        "1.2.840.10008.5.1.4.1.1.128",   // PET
        "1.2.840.10008.5.1.4.1.1.7",     // Secondary Capture
        "1.2.840.10008.5.1.4.1.1.7.2",   // Multi-frame Secondary Capture, grey
        "1.2.840.10008.5.1.4.1.1.7.4",   // Multi-frame Secondary Capture, colored
        "1.2.840.10008.5.1.4.1.1.2.1",   // Enhanced CT
        "1.2.840.10008.5.1.4.1.1.4.1",   // Enhanced MR
        "1.2.840.10008.5.1.4.1.1.66.4",  // Segmentation
        "1.2.840.10008.5.1.4.1.1.481.3", // RT Structure Set
    };
    return classes;
}

} // namespace pellucid::network
