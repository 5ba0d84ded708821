// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/memory.h"

#include <fstream>
#include <limits>
#include <string>

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

} // namespace pellucid::task
