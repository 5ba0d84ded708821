// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::network::process {

/// Permanently gives up everything that open sockets and files do not need: other files, other
/// connections, other processes. *Returns* the bits of platform::Confinement that are in force.
int confine();

/// As confine(), but this process may accept connections on a listening socket that is open, and
/// can write no file at all.
int confineToAccepting();

} // namespace pellucid::network::process
