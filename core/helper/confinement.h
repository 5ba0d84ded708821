// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

namespace pellucid::helper {

/// The protections in force, as bits of the code with which it reports that it is ready.
enum Confinement : std::int32_t { limitsHold = 1, callsAreFiltered = 2, filesAreFiltered = 4 };

struct ResourceLimits {
    std::uint64_t memoryBytes = 0; ///< private memory
    /// The largest file that it may write; 0: none.
    std::uint64_t fileBytes = 0;
};

/// Limits memory, files, processes and dumps, and makes this process the first to be killed if
/// memory runs out. *Shape*: whether all limits are in force.
bool limitResources(const ResourceLimits &limits);

/// A system call that is allowed with this second argument only.
struct AllowedCommand {
    int call = 0, argument = 0;
};

/// Forbids all system calls except those that computing and talking through open sockets need,
/// `more` and `commands`. Calls that only a compromised helper makes end the process, unless `more`
/// has them; others fail
/// with EPERM, so a library that tries to read a table continues without it. *Shape*: whether the
/// filter is in force.
bool filterCalls(std::initializer_list<int> more = {},
                 std::initializer_list<AllowedCommand> commands = {});

/// Forbids opening, creating, and changing any file, where the kernel has Landlock. *Shape*:
/// whether that is in force.
bool forbidFiles();

} // namespace pellucid::helper
