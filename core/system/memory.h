// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

namespace pellucid::system {

/// The address space that the process's own limit still allows; the maximum if unlimited.
std::size_t mappableBytes();

/// The memory that the process's control groups (of a session or a container; either version) still
/// allow, including reclaimable pages; the maximum if unlimited. `root`: the folder of /proc and
/// /sys.
std::size_t groupFreeBytes(const std::filesystem::path &root = "/");

/// Memory that is available without displacing other programs, within the limits of the process and
/// its groups; the maximum if unknown.
std::size_t freeMemoryBytes();

/// The part of it that may be requested at once: within a limit, some is reserved for libraries.
std::size_t availableMemoryBytes();

/// Called before large allocations, because systems that overcommit grant memory that they do not
/// have, and kill the program later. *Throws* Error{outOfMemory} if `bytes` are not available.
void requireMemory(double bytes);

} // namespace pellucid::system
