// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/confine.h"

#include <fcntl.h>
#include <limits>

#include <seccomp.h>

#include "core/helper/confinement.h"
#include "core/system/memory.h"

namespace pellucid::network {

namespace {

constexpr std::uint64_t accepterBytes = 256 << 20;

int bitsOf(bool limitsHold, bool isFiltered, bool hasNoFiles) {
    return (limitsHold ? helper::limitsHold : 0) | (isFiltered ? helper::callsAreFiltered : 0) |
           (hasNoFiles ? helper::filesAreFiltered : 0);
}

} // namespace

int confine() {
    const bool holds =
        helper::limitResources({.memoryBytes = system::freeMemoryBytes(),
                                .fileBytes = std::numeric_limits<std::uint64_t>::max()});
    const bool hasNoFiles = helper::forbidFiles();
    // The files that objects are written to and read from come from the program, already open.
    const bool isFiltered = helper::filterCalls(
        {SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(select), SCMP_SYS(pselect6), SCMP_SYS(sendto),
         SCMP_SYS(recvfrom), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(pwrite64),
         SCMP_SYS(shutdown), SCMP_SYS(setsockopt), SCMP_SYS(getsockopt), SCMP_SYS(getpeername),
         SCMP_SYS(getsockname), SCMP_SYS(lseek), SCMP_SYS(fstat), SCMP_SYS(newfstatat),
         SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep)},
        // Not the commands that send signals.
        {{SCMP_SYS(fcntl), F_GETFD},
         {SCMP_SYS(fcntl), F_SETFD},
         {SCMP_SYS(fcntl), F_GETFL},
         {SCMP_SYS(fcntl), F_SETFL}});
    return bitsOf(holds, isFiltered, hasNoFiles);
}

int confineToAccepting() {
    const bool holds = helper::limitResources({.memoryBytes = accepterBytes, .fileBytes = 0});
    const bool hasNoFiles = helper::forbidFiles();
    const bool isFiltered =
        helper::filterCalls({SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(sendto), SCMP_SYS(recvfrom),
                             SCMP_SYS(shutdown), SCMP_SYS(accept4)});
    return bitsOf(holds, isFiltered, hasNoFiles);
}

} // namespace pellucid::network
