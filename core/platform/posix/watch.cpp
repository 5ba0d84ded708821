// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/watch.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sys/time.h>
#include <unistd.h>

namespace pellucid::platform {

namespace {

const pid_t program = ::getppid(); // first, before the program can end
volatile std::sig_atomic_t secondsLeft = 0;

void tick(time_t seconds) {
    const itimerval each{{seconds, 0}, {seconds, 0}};
    // Counts processor time, so that a slow disc or network share does not count.
    ::setitimer(ITIMER_PROF, &each, nullptr);
}

} // namespace

Watch::Watch() {
    struct sigaction look {};
    look.sa_handler = [](int) {
        if (::getppid() != program)
            ::_exit(1);
        secondsLeft = secondsLeft - 1;
        if (secondsLeft > 0)
            return;
        ::signal(SIGPROF, SIG_DFL);
        ::raise(SIGPROF);
    };
    look.sa_flags = SA_RESTART;
    ::sigaction(SIGPROF, &look, nullptr);
}

void Watch::allow(double seconds) {
    constexpr double years = 1e8; // a sparse file can have any size
    m_seconds = int(std::ceil(std::min(seconds, years)));
    resume();
}

void Watch::resume() {
    secondsLeft = m_seconds;
    tick(1);
}

void Watch::pause() {
    tick(0);
}

} // namespace pellucid::platform
