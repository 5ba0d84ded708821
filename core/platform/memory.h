// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

namespace pellucid::platform {

/// How much more address space the process may use; the maximum if nothing limits it.
std::size_t mappableBytes();

/// The memory that the process's control groups (of a session or a container; either version) still
/// allow, including reclaimable pages; the maximum if unlimited. `root`: the folder of /proc and
/// /sys. On Windows, the limits of the process's job.
std::size_t groupFreeBytes(const std::filesystem::path &root = "/");

/// Memory that is available without displacing other programs, within the limits of the process and
/// its groups; the maximum if unknown.
std::size_t freeMemoryBytes();

inline constexpr std::size_t largePage = std::size_t(2) << 20;
/// Whole large pages, which start at a multiple of their size. *Shape*: `bytes` is one, too. Null
/// if the system refuses, or if sanitizers are to check the bounds of memory.
std::byte *mapLargePages(std::size_t bytes);
void unmapLargePages(std::byte *memory, std::size_t bytes);
/// Returns such pages to the system, but keeps their addresses; their contents are lost.
void discardLargePages(std::byte *memory, std::size_t bytes);

/// Keeps memory that is freed for the next allocation: returning it to the system costs a page
/// fault for every 4 KB, which took five times as long as decoding a plain slice.
void keepFreedMemory();
/// Returns memory that is freed to the system.
void returnFreedMemory();

/// From now on, this process's memory, which has passwords and patients, gets into no core dump;
/// nor does that of the programs that it starts.
void leaveMemoryOutOfDumps();
/// From now on, this process's memory, which has passwords and patients, gets into no core dump,
/// and only root may read it from outside; on Windows, only the former. Not inherited by the
/// programs that this one starts.
void hideMemory();

} // namespace pellucid::platform
