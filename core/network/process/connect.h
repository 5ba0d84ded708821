// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/network/client/peer.h"
#include "core/network/process/control.h"

namespace pellucid::network::process {

/// A TCP connection, and the address at its other end, IPv6 or IPv4.
struct Connected {
    int socket = -1; ///< of the caller
    std::string address;
};

/// Connects to a server: to the first of its addresses that answers. Reports Step::name. *Throws*
/// Lost.
Connected connectTo(const Peer &peer, Control &control);

/// Takes the connection over: the next socket that a library of this process connects becomes it,
/// whatever address the library names. DCMTK 3.6.7 knows no IPv6.
void useAtNextConnect(int socket);

} // namespace pellucid::network::process
