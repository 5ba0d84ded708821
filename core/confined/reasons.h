// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(systemDoesNotProtect, "this system cannot confine the processes that read files and talk to servers (no seccomp): a hostile file could do whatever you can do")
// clang-format on

} // namespace pellucid::task::because
