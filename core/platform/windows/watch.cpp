// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/watch.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "core/platform/windows/start.h"

namespace pellucid::platform {

namespace {

// Of the processor's time, in seconds; 0: no limit. The system ends this process with the program.
std::atomic<double> limit = 0.0;

double processorSeconds() {
    FILETIME start{}, end{}, kernel{}, user{};
    if (::GetProcessTimes(::GetCurrentProcess(), &start, &end, &kernel, &user) == FALSE)
        return 0.0;
    const auto ticks = [](const FILETIME &time) {
        return double(std::uint64_t(time.dwHighDateTime) << 32 | time.dwLowDateTime);
    };
    return (ticks(kernel) + ticks(user)) * 1e-7;
}

} // namespace

Watch::Watch() {
    std::thread([] {
        constexpr DWORD lookMs = 200;
        for (;; ::Sleep(lookMs))
            if (const double end = limit; end > 0.0 && processorSeconds() > end)
                ::TerminateProcess(::GetCurrentProcess(), endedByWatch);
    }).detach();
}

void Watch::allow(double seconds) {
    constexpr double years = 1e8; // a sparse file can have any size
    m_seconds = int(std::ceil(std::min(seconds, years)));
    resume();
}

void Watch::resume() {
    limit = processorSeconds() + m_seconds;
}

void Watch::pause() {
    limit = 0.0;
}

} // namespace pellucid::platform
