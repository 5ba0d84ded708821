// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "core/platform/handle.h"

/// Files by handle. All functions *throw* std::system_error, but for those that return an optional.
namespace pellucid::platform {

/// The number of the error of a disk on which this user may write no more.
int quotaExceeded();

/// The path by name of a file in a folder that is reached by its handle; any other path as it is.
std::filesystem::path pathByName(const std::filesystem::path &path);

/// The same for all paths that lead to a file, through links of either kind.
struct FileId {
    std::uint64_t device = 0, number = 0;
    auto operator<=>(const FileId &) const = default;
};
/// None if there is no such file.
std::optional<FileId> fileIdOf(const std::filesystem::path &path);

struct FileFacts {
    bool isRegular = false;
    std::uint64_t bytes = 0;
    /// When content or location last changed, in nanoseconds: unlike the date of modification, it
    /// cannot be set back.
    std::int64_t changed = 0;
    bool operator==(const FileFacts &) const = default;
};
FileFacts factsOf(const Handle &file);

/// Does not block on a pipe or a device, even if the path has just become one.
Handle openForReading(const std::filesystem::path &path);
/// Fills `to` from the position of the handle on; less at the end of the file, and then nothing.
std::size_t readSome(const Handle &file, std::span<std::byte> to);
/// The same from a place in the file; the handle keeps its position.
std::size_t readAt(const Handle &file, std::uint64_t from, std::span<std::byte> to);
void writeAll(const Handle &file, std::span<const std::byte> bytes);

/// For reading and writing; a new file is the user's alone. An empty handle if that is impossible.
Handle openOrCreate(const std::filesystem::path &path);
enum class Lock { wait, attempt };
/// Locks a file against other programs that do the same, until its handle is closed. False if
/// another one holds it; *throws* if nobody can lock it.
bool lock(const Handle &file, Lock how);

enum class Access { read, write };
/// The start of a file, or of memory that processes share, as bytes in memory. *Requires*: not
/// empty.
std::span<std::byte> map(HandleView file, std::size_t bytes, Access access);
/// Only parts of what is mapped will be read: without read-ahead, which discs and network shares
/// are slow at.
void expectFewReads(std::span<const std::byte> mapped);
void unmap(std::span<std::byte> mapped);

} // namespace pellucid::platform
