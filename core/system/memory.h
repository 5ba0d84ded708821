// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace pellucid::system {

/// The part of the free memory that may be requested at once: within a limit, some is reserved for
/// libraries.
std::size_t availableMemoryBytes();

/// Called before large allocations, because systems that overcommit grant memory that they do not
/// have, and kill the program later. *Throws* Error{outOfMemory} if `bytes` are not available.
void requireMemory(double bytes);

} // namespace pellucid::system
