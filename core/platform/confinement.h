// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace pellucid::platform {

/// The protections in force, as bits of the code with which a helper reports that it is ready.
enum Confinement : std::int32_t {
    limitsHold = 1,
    callsAreFiltered = 2,
    filesAreFiltered = 4,
    networkIsEmpty = 8
};

/// A confined helper uses sockets in one of these ways.
enum class Talks {
    toTheProgram,     ///< through its channel alone
    throughItsSocket, ///< which is connected, and it reads and writes the files that it is given
    toThoseWhoConnect ///< to a listening socket that is open
};

struct Needs {
    std::uint64_t memoryBytes = 0; ///< private memory
    /// The largest file that it may write; 0: none. Windows limits no files.
    std::uint64_t fileBytes = 0;
    Talks talks = Talks::toTheProgram;
};

/// Gives up everything but what a helper needs. Limits memory, files, processes and dumps, and
/// makes this process the first to be killed if memory runs out. Forbids opening, creating and
/// changing any file, other processes, and all of the network but what it `talks` to. What only a
/// compromised helper does ends the process; other calls fail, so a library that tries to read a
/// table continues without it. *Requires*: one thread. *Returns* the bits of Confinement.
int confine(const Needs &needs);

} // namespace pellucid::platform
