// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/memory.h"

#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::task {

std::size_t availableMemoryBytes() {
    std::ifstream info("/proc/meminfo");
    std::string name, unit;
    std::size_t kilobytes = 0;
    while (info >> name >> kilobytes >> unit)
        if (name == "MemAvailable:")
            return kilobytes * 1024;
    return std::numeric_limits<std::size_t>::max();
}

void requireMemory(double bytes) {
    const std::size_t available = availableMemoryBytes();
    if (bytes > double(available))
        throw Error(ErrorCode::outOfMemory,
                    fmt::format("needs {:.0f} MB of memory, there are {} MB", bytes / 1048576.0,
                                available >> 20));
}

} // namespace pellucid::task
