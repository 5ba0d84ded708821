// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace pellucid::task {

/// Runs the work and all that it does in parallel on the calling thread alone.
void onThisThread(const std::function<void()> &work);

} // namespace pellucid::task
