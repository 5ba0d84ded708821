// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/platform/channel.h"
#include "core/task/progress.h"

namespace pellucid::confined {

/// Waits until a packet, or the end, can be read. False after the deadline. *Throws* Cancelled.
bool waitForPacket(const platform::Channel &channel, double seconds,
                   const task::Progress &progress);

/// The path of a program that is installed with this one: beside it or where packages install it,
/// or the value of an environment variable.
std::filesystem::path findProgram(const char *name, const char *variable);

} // namespace pellucid::confined
