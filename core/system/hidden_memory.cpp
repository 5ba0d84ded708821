// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/hidden_memory.h"

#include <fstream>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace pellucid::system {

// A limit of 0 on core dumps would not stop those that go to a program (core(5)), as systemd's do.
void leaveMemoryOutOfDumps() {
#ifdef __linux__
    std::ofstream("/proc/self/coredump_filter") << "0\n";
#endif
}

void hideMemory() {
#if defined(__linux__) && !defined(PELLUCID_SANITIZED) // the search for leaks debugs the process
    ::prctl(PR_SET_DUMPABLE, 0);
#endif
}

} // namespace pellucid::system
