// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <fstream>
#include <netinet/in.h>
#include <string>
#include <sys/types.h>

namespace pellucid::network::process {

/// Tells which connections to a port of this computer are of programs of this user. Made before the
/// process is confined.
class ConnectionOwner {
public:
    /// `listening`: a TCP socket for IPv4.
    explicit ConnectionOwner(int listening);
    /// Whether a program of this user has an open connection from there. True if the system does
    /// not tell.
    bool isThisUser(const sockaddr_in &from);

private:
    std::array<std::ifstream, 2> m_tables;
    std::string m_port;
    uid_t m_user;
};

} // namespace pellucid::network::process
