// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/background.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif
#include <tbb/task_arena.h>

namespace pellucid::task {

void lowerPriority() {
#ifdef __linux__
    // On Linux, each thread has its own priority.
    setpriority(PRIO_PROCESS, id_t(gettid()), 19);
#endif
}

void onThisThread(const std::function<void()> &work) {
    tbb::task_arena(1).execute(work);
}

} // namespace pellucid::task
