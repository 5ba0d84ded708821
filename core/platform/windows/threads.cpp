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

} // namespace pellucid::platform
