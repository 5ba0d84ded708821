// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace pellucid::test {

/// Limits the address space that the process may still add, as long as the object exists. Not for
/// sanitized builds, which reserve terabytes.
class LittleMemory {
public:
    explicit LittleMemory(std::size_t moreMb) {
        getrlimit(RLIMIT_AS, &m_before);
        rlim_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit little{pages * rlim_t(sysconf(_SC_PAGESIZE)) + (rlim_t(moreMb) << 20),
                            m_before.rlim_max};
        setrlimit(RLIMIT_AS, &little);
    }
    ~LittleMemory() { setrlimit(RLIMIT_AS, &m_before); }
    LittleMemory(const LittleMemory &) = delete;
    LittleMemory &operator=(const LittleMemory &) = delete;

private:
    rlimit m_before{};
};

} // namespace pellucid::test
