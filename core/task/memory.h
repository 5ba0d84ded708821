// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace pellucid::task {

/// What the process's own limit leaves it to map, used or not; the largest size without one.
std::size_t mappableBytes();

/// Memory that can be had without pushing other programs out, and within the process's limit; the
/// largest size if it is not known.
std::size_t freeMemoryBytes();

/// As much of it as may be asked for at once: of a limit, libraries keep what they need to go on.
std::size_t availableMemoryBytes();

/// Asked before memory is: systems that overcommit give what they do not have, and kill later.
/// *Throws* Error{outOfMemory} if `bytes` are not available.
void requireMemory(double bytes);

} // namespace pellucid::task
