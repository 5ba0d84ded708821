// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace pellucid::system {

/// Takes what is worth knowing when something went wrong on a machine far away: versions, devices,
/// what a driver says. Never a patient's name, nor a file's. From any thread.
using LogSink = std::function<void(const std::string &line)>;

/// Where log lines go; nowhere until it is set. *Shape*: set once, before other threads begin.
void setLogSink(LogSink sink);
void log(const std::string &line);

} // namespace pellucid::system
