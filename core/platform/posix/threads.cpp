// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/threads.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace pellucid::platform {

std::vector<int> allowedProcessors() {
    std::vector<int> list;
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0)
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
            if (CPU_ISSET(cpu, &set))
                list.push_back(cpu);
    return list;
}

int currentProcessor() {
    return ::sched_getcpu();
}

void stayOn(int processor) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set);
}

void lowerPriority() {
    // On Linux, each thread has its own priority.
    ::setpriority(PRIO_PROCESS, id_t(::gettid()), 19);
}

void sleepWhile(const std::atomic<std::uint32_t> &number, std::uint32_t seen) {
    number.wait(seen);
}

void wakeOne(std::atomic<std::uint32_t> &number) {
    number.notify_one();
}

} // namespace pellucid::platform
