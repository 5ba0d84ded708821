// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "core/archive/retrieval.h"
#include "core/archive/server.h"

namespace pellucid::cli {

/// The servers of these names, with the secrets that they need: asked for on the terminal, without
/// an echo, because arguments, files and the environment can be read by others. For a login in the
/// browser, prints its address to standard error, and waits. *Throws* Error{usage} if there is no
/// such server, or no terminal to ask on; as archive::Login::logIn; Cancelled.
std::vector<archive::Server> serversNamed(const std::vector<std::string> &names,
                                          const Context &context);
archive::Server serverNamed(const std::string &name, const Context &context);

/// The rate of a transfer, in MB/s.
std::string rateText(std::uint64_t bytes, double seconds);

/// Runs a retrieval; the terminal, if there is one, shows how far it is. *Throws* as `retrieve`.
archive::RetrievalReport watched(
    const std::function<archive::RetrievalReport(const archive::RetrievalObserver &)> &retrieve);

/// Names the missing objects, by their UIDs, on standard error.
void warnOfObjects(const archive::RetrievalReport &report);

/// *Throws* Error{incomplete} if objects are missing.
void requireComplete(const archive::RetrievalReport &report, const std::string &server);

} // namespace pellucid::cli
