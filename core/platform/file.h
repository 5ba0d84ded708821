// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <system_error>

#include "core/platform/handle.h"

/// Files by handle. All functions *throw* std::system_error, but for those that return an optional.
namespace pellucid::platform {

/// The error number for an exceeded disk quota.
int quotaExceeded();

/// The path by name of a file in a folder that is reached by its handle; any other path as it is.
std::filesystem::path pathByName(const std::filesystem::path &path);

/// Whether two names in a folder mean the same file: on Windows, letters of either case are equal.
bool isSameName(const std::filesystem::path &a, const std::filesystem::path &b);

/// An entry of a folder.
struct Entry {
    std::filesystem::path path;
    enum class Kind { file, folder, other } kind = Kind::other; ///< of what a link leads to
    bool isLink = false;
};
/// Lists a folder, whatever the length of its path. *Returns* why not all of it could be read.
std::error_code listFolder(const std::filesystem::path &folder,
                           const std::function<void(const Entry &)> &take);
/// The longest path that the standard library's streams open on every machine, in characters.
std::size_t longestStreamPath();

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
std::size_t readSome(HandleView file, std::span<std::byte> to);
/// The same from a place in the file; the handle keeps its position.
std::size_t readAt(HandleView file, std::uint64_t from, std::span<std::byte> to);
void writeAll(HandleView file, std::span<const std::byte> bytes);

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
