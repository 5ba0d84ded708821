// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#ifdef _WIN32
#include "core/platform/windows/error.h"
// After winsock2.h.
#include <ws2tcpip.h>
#else
#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#endif

/// Addresses as all systems have them.
namespace pellucid::platform {

#ifndef _WIN32
inline void useSockets() {}
#endif

/// An address and a port, of either kind.
union Place {
    sockaddr any;
    sockaddr_in at4;
    sockaddr_in6 at6;
    sockaddr_storage all{};
};

/// The address; one of IPv4 that is mapped into IPv6 as the former.
std::string textOf(const Place &place);
int portOf(const Place &place);
/// None if the text is no address.
std::optional<Place> placeIn(const std::string &text);
/// An address of this computer to listen on; empty: all of them. *Throws* std::system_error, as
/// listenOn() does.
Place ownPlace(const std::string &address, int port);

} // namespace pellucid::platform
