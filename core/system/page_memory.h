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

/// Returns the large pages that lie wholly within a part of such memory to the system. The part's
/// contents are lost. *Requires*: the memory ends where the part ends.
void returnPages(std::byte *from, std::size_t bytes);

} // namespace pellucid::system
