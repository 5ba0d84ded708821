// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace pellucid::platform {

/// The number of this process.
long ownProcess();
/// Distinguishes a running process from later ones with the same number. Empty if there is none.
std::string processIdentity(long process);
/// The file of the running program; empty if unknown.
std::filesystem::path programFile();

/// Sets an environment variable, of this program and those that it starts, unless it is set.
void setMissingVariable(const char *name, const std::string &value);

/// From now on, writing beyond the limit of a file's size fails instead of ending the program.
void letLongFilesFail();
/// The same for writing where nobody reads.
void letBrokenPipesFail();
/// From now on, `first` is called if the program is asked to end, and `second` if it is asked
/// again, on a thread of their own. Before any other thread is started.
void whenAskedToEnd(std::function<void()> first, std::function<void()> second);

/// Half of what the main thread's stack may grow to; other threads have as much by default.
std::size_t stackToUse();
/// Bytes that nobody can guess, at most 256. *Throws* std::system_error.
void fillRandomly(std::span<std::byte> bytes);
/// Whether a person reads what is written there.
bool isTerminal(std::FILE *stream);

/// This machine; texts are empty, and the bytes 0, if unknown.
struct Machine {
    std::string system, processor;
    std::size_t memoryBytes = 0;
};
Machine thisMachine();

} // namespace pellucid::platform
