// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

namespace pellucid::system {

/// What the process's own limit leaves it to map, used or not; the largest size without one.
std::size_t mappableBytes();

/// What the control groups that the process is in (of a session, a container; either version) leave
/// it, pages that can be dropped included; the largest size without one. `root`: where /proc and
/// /sys are.
std::size_t groupFreeBytes(const std::filesystem::path &root = "/");

/// Memory that can be had without pushing other programs out, and within the limits of the
/// process and its groups; the largest size if it is not known.
std::size_t freeMemoryBytes();

/// As much of it as may be asked for at once: of a limit, libraries keep what they need to go on.
std::size_t availableMemoryBytes();

/// Asked before memory is: systems that overcommit give what they do not have, and kill later.
/// *Throws* Error{outOfMemory} if `bytes` are not available.
void requireMemory(double bytes);

} // namespace pellucid::system
