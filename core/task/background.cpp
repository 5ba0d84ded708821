// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/background.h"

#include <tbb/task_arena.h>

namespace pellucid::task {

void onThisThread(const std::function<void()> &work) {
    tbb::task_arena(1).execute(work);
}

} // namespace pellucid::task
