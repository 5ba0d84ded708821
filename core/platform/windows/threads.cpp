// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/threads.h"

#include "core/platform/windows/error.h"

namespace pellucid::platform {

std::vector<int> allowedProcessors() {
    DWORD_PTR own = 0, all = 0;
    std::vector<int> list;
    if (::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all) != FALSE)
        for (int cpu = 0; cpu < int(8 * sizeof own); ++cpu)
            if ((own >> cpu & 1) != 0)
                list.push_back(cpu);
    return list;
}

int currentProcessor() {
    return int(::GetCurrentProcessorNumber());
}

void stayOn(int processor) {
    ::SetThreadAffinityMask(::GetCurrentThread(), DWORD_PTR(1) << processor);
}

void lowerPriority() {
    ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST);
}

// Not by the number's own functions: on Windows, those of GCC 12.2 look at it before they take the
// lock of their condition, and a thread that is woken in between sleeps for ever.
void sleepWhile(const std::atomic<std::uint32_t> &number, std::uint32_t seen) {
    ::WaitOnAddress(const_cast<std::atomic<std::uint32_t> *>(&number), &seen, sizeof seen,
                    INFINITE);
}

void wakeOne(std::atomic<std::uint32_t> &number) {
    ::WakeByAddressSingle(&number);
}

} // namespace pellucid::platform
