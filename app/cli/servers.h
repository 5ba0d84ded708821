// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/archive/server.h"

namespace pellucid::cli {

/// The servers of these names, with the secrets that they need: asked for on the terminal, without
/// an echo, because arguments, files and the environment can be read by others. *Throws*
/// Error{usage} if there is no such server, or no terminal to ask on.
std::vector<archive::Server> serversNamed(const std::vector<std::string> &names);
archive::Server serverNamed(const std::string &name);

/// The line about objects per second of a transfer.
std::string rateText(std::uint64_t bytes, double seconds);

} // namespace pellucid::cli
