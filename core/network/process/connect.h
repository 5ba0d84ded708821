// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/network/client/peer.h"
#include "core/network/process/control.h"
#include "core/platform/socket.h"

namespace pellucid::network::process {

/// Connects to a server: to the first of its addresses that answers. Reports Step::name. *Throws*
/// Lost.
platform::Connected connectTo(const Peer &peer, Control &control);

} // namespace pellucid::network::process
