// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
bool awaitInput(HandleView socket, int milliseconds);

struct Connected {
    Handle socket;
    std::string address; ///< of the other end
    int port = 0;
};
/// None if the connection has gone, or the program has too many files open. `accepting`: how the
/// new socket behaves. *Throws* std::system_error if this process can accept no more.
std::optional<Connected> acceptFrom(HandleView listening, Accepting accepting = Accepting::waits);

/// Connects to an address. The socket waits for nothing, until `makeWaiting`. *Throws*
/// std::system_error.
Handle connectTo(const std::string &address, int port, double seconds);

void makeWaiting(HandleView socket);

/// Sends what fits into the buffers of a connection, and nothing more later.
void sendLast(HandleView socket, std::string_view bytes);
/// Reads what is there: 0 bytes at the end; none if nothing is there yet.
std::optional<std::size_t> receiveSome(HandleView socket, std::span<char> to);

/// Whether the last call that sent something has failed because the other end has closed.
bool otherEndHasHungUp();

/// From now on, what is written is sent at once.
void sendAtOnce(HandleView socket);
/// Acknowledges received data at once, for a while. Without these two, each object waits for the
/// delayed acknowledgement of the last one: 40 ms.
void acknowledgeAtOnce(HandleView socket);

/// An address of 4 or 16 bytes as text; empty if it has another length.
std::string addressText(std::span<const unsigned char> bytes);

} // namespace pellucid::platform
