// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::task {

std::size_t mappableBytes() {
    rlimit limit{};
    std::size_t pages = 0;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        !(std::ifstream("/proc/self/statm") >> pages))
        return std::numeric_limits<std::size_t>::max();
    const std::size_t mapped = pages * std::size_t(sysconf(_SC_PAGESIZE));
    return limit.rlim_cur > mapped ? limit.rlim_cur - mapped : 0;
}

std::size_t freeMemoryBytes() {
    std::ifstream info("/proc/meminfo");
    std::string name, unit;
    std::size_t kilobytes = 0;
    while (info >> name >> kilobytes >> unit)
        if (name == "MemAvailable:")
            return std::min(kilobytes * 1024, mappableBytes());
    return mappableBytes();
}

std::size_t availableMemoryBytes() {
    // Some libraries (FFTW, Qt, Mesa) end the program when they get nothing for their small things.
    constexpr std::size_t ofLibraries = std::size_t(192) << 20;
    const std::size_t mappable = mappableBytes();
    return std::min(freeMemoryBytes(), mappable > ofLibraries ? mappable - ofLibraries : 0);
}

void requireMemory(double bytes) {
    const std::size_t available = availableMemoryBytes();
    if (bytes > double(available))
        throw Error(ErrorCode::outOfMemory,
                    fmt::format("needs {:.0f} MB of memory, there are {} MB", bytes / 1048576.0,
                                available >> 20));
}

} // namespace pellucid::task
