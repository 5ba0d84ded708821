// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace pellucid::platform {

/// The processors that this process may run on, by number; none if unknown.
std::vector<int> allowedProcessors();
/// The processor that the calling thread runs on; -1 if unknown.
int currentProcessor();
/// From now on, the calling thread runs on this processor alone. A system that refuses leaves it as
/// it is.
void stayOn(int processor);
/// Gives the calling thread the lowest priority, for good. A system that refuses leaves it as it
/// is.
void lowerPriority();

/// A moment's rest for the processor, within a loop that waits for another thread.
inline void rest() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/// Sleeps while a number is `seen`, until it is woken. Only other threads of this process wake it.
void sleepWhile(const std::atomic<std::uint32_t> &number, std::uint32_t seen);
/// Wakes one thread that sleeps on a number, which was changed before.
void wakeOne(std::atomic<std::uint32_t> &number);

} // namespace pellucid::platform
