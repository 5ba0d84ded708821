// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/memory.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/platform/memory.h"
#include "core/system/reasons.h"
#include "core/task/error.h"

namespace pellucid::system {

std::size_t availableMemoryBytes() {
    // Some libraries (FFTW, Qt, Mesa) abort if a small allocation fails.
    constexpr std::size_t libraryReserve = std::size_t(192) << 20;
    const std::size_t mappable = platform::mappableBytes();
    return std::min(platform::freeMemoryBytes(),
                    mappable > libraryReserve ? mappable - libraryReserve : 0);
}

void requireMemory(double bytes) {
    const std::size_t available = availableMemoryBytes();
    if (bytes > double(available))
        throw task::Error(
            task::ErrorCode::outOfMemory,
            task::because::needsMemory(fmt::format("{:.0f}", std::ceil(bytes / 1048576.0)),
                                       available >> 20));
}

} // namespace pellucid::system
