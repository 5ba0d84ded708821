// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>

#include "core/task/reason.h"

namespace pellucid::system {

/// Uninitialised memory on large pages if the system has them (2 MB aligned): otherwise scattered
/// reads of a spectrum miss the TLB as often as the data cache. *Throws* Error{outOfMemory}, naming
/// `what`.
std::shared_ptr<std::byte[]> allocatePages(std::size_t bytes, task::Because<0> what);

/// Returns the large pages of such memory that lie wholly behind its first `kept` bytes to the
/// system; their contents are lost. `bytes`: of the memory. No effect if it has no large pages.
void returnPages(std::byte *memory, std::size_t bytes, std::size_t kept);

} // namespace pellucid::system
