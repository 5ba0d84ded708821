// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace pellucid::task {

/// Gives the calling thread the lowest priority, for good: it works while no other thread needs
/// its processor. A system that refuses leaves it as it is.
void lowerPriority();

/// Runs the work and all that it does in parallel on the calling thread alone.
void onThisThread(const std::function<void()> &work);

} // namespace pellucid::task
