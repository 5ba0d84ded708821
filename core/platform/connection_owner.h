// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::platform {

/// Whether a program of this user has an open connection from this address and port, of IPv4, to
/// this port of 127.0.0.1. True if the system does not report it.
bool isOfThisUser(const std::string &address, int port, int to);

} // namespace pellucid::platform
