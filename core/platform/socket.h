// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/platform/handle.h"

/// Connections, and addresses as text: IPv4 or IPv6.
namespace pellucid::platform {

enum class AddressKind { ipv4, ipv6 };
/// None if the text is no address.
std::optional<AddressKind> addressKind(const std::string &text);
/// Whether an address is of this computer alone: 127.0.0.0/8 (RFC 1122, 3.2.1.3) or ::1.
bool isLoopback(const std::string &address);
/// The addresses of a host, as the system resolves them; empty if it knows none. One of IPv4 that
/// is mapped into IPv6 (RFC 4291, 2.5.5.2) as the former.
std::vector<std::string> addressesOf(const std::string &host);

struct ListeningSocket {
    Handle socket;
    int port = 0;
};
enum class Accepting { waits, neverWaits };
/// Waits for connections to a port of this computer; 0: any that is free. `address`: one of its
/// own; empty: all of them, IPv6 and IPv4. `waiting`: connections that the system keeps until they
/// are accepted. *Throws* std::system_error; invalid_argument if nobody can connect to such an
/// address.
ListeningSocket listenOn(const std::string &address, int port, int waiting,
                         Accepting accepting = Accepting::waits);

/// Whether there is a connection, or something to read, within so many milliseconds.
bool awaitInput(const Handle &socket, int milliseconds);

struct Connected {
    Handle socket;
    std::string address; ///< of the other end
};
/// None if the connection has gone, or the program has too many files open.
std::optional<Connected> acceptFrom(const Handle &listening);

} // namespace pellucid::platform
