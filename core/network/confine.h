// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::network {

/// Gives up for good whatever talking through the open sockets does not need: other files, other
/// connections, processes. *Shape*: the bits of helper::Confinement that are in force.
int confine();

} // namespace pellucid::network
