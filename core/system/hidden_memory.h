// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::system {

/// From now on, this process's memory, which has passwords and patients, gets into no core dump;
/// nor does that of the programs that it starts.
void leaveMemoryOutOfDumps();

/// From now on, this process's memory, which has passwords and patients, gets into no core dump,
/// and only root may read it from outside. Not inherited by the programs that this one starts.
void hideMemory();

} // namespace pellucid::system
