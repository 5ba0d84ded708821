// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/platform/handle.h"
#include "core/platform/socket.h"

namespace pellucid::platform {

/// Tells which connections to a port of this computer are of programs of this user. Made before the
/// process is confined.
class ConnectionOwner {
public:
    /// `listening`: a TCP socket for IPv4.
    explicit ConnectionOwner(HandleView listening);
    ~ConnectionOwner();
    /// Whether a program of this user has an open connection from there. True if the system does
    /// not tell.
    bool isThisUser(const Connected &from);

private:
    struct Tables;
    std::unique_ptr<Tables> m_tables;
};

} // namespace pellucid::platform
