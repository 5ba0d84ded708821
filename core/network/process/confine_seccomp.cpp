// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/confine.h"

#include <algorithm>
#include <fcntl.h>
#include <limits>
#include <sys/socket.h>

#include <seccomp.h>

#include "core/confined/confinement.h"
#include "core/platform/memory.h"

namespace pellucid::network::process {

namespace {

// The answers of a server are read whole. A list of a million objects took 2.8 GB, so that of the
// 100,000 objects that a study may have takes about a third of this.
constexpr std::uint64_t mostBytes = std::uint64_t(1) << 30, accepterBytes = 256 << 20;

} // namespace

// The files that objects are written to and read from come from the program, already open. Not
// newfstatat, which tells what any path leads to.
int confine() {
    return confined::confine(
        {.memoryBytes = std::min<std::uint64_t>(platform::freeMemoryBytes(), mostBytes),
         .fileBytes = std::numeric_limits<std::uint64_t>::max(),
         .calls = {SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(select), SCMP_SYS(pselect6),
                   SCMP_SYS(recvfrom), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(pwrite64),
                   SCMP_SYS(shutdown), SCMP_SYS(setsockopt), SCMP_SYS(getsockopt),
                   SCMP_SYS(getpeername), SCMP_SYS(getsockname), SCMP_SYS(lseek),
                   SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep)},
         // Not the commands that send signals.
         .commands = {{SCMP_SYS(fcntl), F_GETFD},
                      {SCMP_SYS(fcntl), F_SETFD},
                      {SCMP_SYS(fcntl), F_GETFL},
                      {SCMP_SYS(fcntl), F_SETFL}}});
}

int confineToAccepting() {
    return confined::confine(
        {.memoryBytes = accepterBytes,
         .calls = {SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(recvfrom), SCMP_SYS(accept4),
                   SCMP_SYS(lseek)},
         // To shut the other direction of a listening socket would free it to connect.
         .commands = {{SCMP_SYS(shutdown), SHUT_WR}}});
}

} // namespace pellucid::network::process
