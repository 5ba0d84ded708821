// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>

namespace pellucid::confined {

/// The protections in force, as bits of the code with which a helper reports that it is ready.
enum Confinement : std::int32_t {
    limitsHold = 1,
    callsAreFiltered = 2,
    filesAreFiltered = 4,
    networkIsEmpty = 8
};

/// A system call that is allowed with this second argument only.
struct AllowedCommand {
    int call = 0, argument = 0;
};

struct Needs {
    std::uint64_t memoryBytes = 0; ///< private memory
    /// The largest file that it may write; 0: none.
    std::uint64_t fileBytes = 0;
    std::initializer_list<int> calls{};
    std::initializer_list<AllowedCommand> commands{};
};

/// Gives up everything but what a helper needs. Limits memory, files, processes and dumps, and
/// makes this process the first to be killed if memory runs out. Moves it, where the system allows
/// that, to a network without interfaces; sockets that are open stay where they are. Forbids
/// opening, creating and changing any file, and reaching a port or the processes of others, as far
/// as the kernel's Landlock can. Forbids all system calls except those that computing and talking
/// through open sockets need, and what it `needs`. Calls that only a compromised helper makes end
/// the process, unless it needs them; others fail with EPERM, so a library that tries to read a
/// table continues without it. *Requires*: one thread. *Returns* the bits of Confinement.
int confine(const Needs &needs);

} // namespace pellucid::confined
