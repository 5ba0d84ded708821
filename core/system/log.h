// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace pellucid::system {

/// Receives information for diagnosing problems remotely: versions, devices, driver messages. Never
/// contains the name of a patient or a file. Thread-safe.
using LogSink = std::function<void(const std::string &line)>;

/// Sets the destination of log lines; without it they are discarded. *Requires*: called once,
/// before other threads start.
void setLogSink(LogSink sink);
void log(const std::string &line);

} // namespace pellucid::system
