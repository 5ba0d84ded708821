// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/confine.h"

#include <algorithm>
#include <limits>

#include "core/platform/confinement.h"
#include "core/platform/memory.h"

namespace pellucid::network::process {

namespace {

// The answers of a server are read whole. A list of a million objects took 2.8 GB, so that of the
// 100,000 objects that a study may have takes about a third of this.
constexpr std::uint64_t mostBytes = std::uint64_t(1) << 30, accepterBytes = 256 << 20;

} // namespace

// The files that objects are written to and read from come from the program, already open.
int confine() {
    return platform::confine(
        {.memoryBytes = std::min<std::uint64_t>(platform::freeMemoryBytes(), mostBytes),
         .fileBytes = std::numeric_limits<std::uint64_t>::max(),
         .talks = platform::Talks::throughItsSocket});
}

int confineToAccepting() {
    return platform::confine(
        {.memoryBytes = accepterBytes, .talks = platform::Talks::toThoseWhoConnect});
}

} // namespace pellucid::network::process
