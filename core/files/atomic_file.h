// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "core/platform/new_file.h"

namespace pellucid::files {

/// *Throws* Error{output} for a link of another user where anybody may make them: it would choose
/// where files of this user go.
void requireTrusted(const std::filesystem::path &link);

/// The file that writing to a path affects: the target if it is a link. *Throws* Error{output} if a
/// file would replace a device or a pipe, or if another user made the link where anybody may.
std::filesystem::path targetOf(const std::filesystem::path &path);

/// A file that appears under its name only when it is complete, see `platform::NewFile`. Not
/// QSaveFile: core does not use Qt, and a killed program leaves QSaveFile's unfinished file behind.
class AtomicFile {
public:
    using Readers = platform::Readers;
    /// *Throws* Error{output} if the folder cannot be written.
    explicit AtomicFile(const std::filesystem::path &path, Readers readers = Readers::usual);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// *Throws* Error{output}, for example if the disk is full.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
    /// The first bytes of an open file. *Throws* Error{output}; Error{unusable} if it has fewer.
    void write(platform::HandleView file, std::uint64_t bytes);
    /// The open file with what has been written, for another process. *Throws* Error{output}.
    platform::HandleView view() const;
    /// A path that leads to it now, as long as this program keeps it open.
    std::filesystem::path currentPath() const;
    /// Chooses a different path before the file appears, on the same file system. *Throws* as
    /// `targetOf`.
    void moveTo(const std::filesystem::path &path) { m_path = targetOf(path); }
    /// `unflushed`: many files are flushed together, by `flush` of their folder.
    enum class Bytes { flushed, unflushed };
    /// *Throws* Error{output}; an existing file of that name is then unchanged.
    void commit(Bytes bytes = Bytes::flushed);

private:
    [[noreturn]] void failWith(int error) const;

    std::filesystem::path m_path;
    std::unique_ptr<platform::NewFile> m_file;
};

/// Renames a complete file within a file system after its bytes are on the disk. *Throws*
/// Error{output}; an existing target is then unchanged.
void rename(const std::filesystem::path &from, const std::filesystem::path &to);

/// Flushes the file system of a folder to the disk. *Throws* Error{output}.
void flush(const std::filesystem::path &folder);

/// Checks before long work: *throws* Error{output} with path and reason if a folder cannot be
/// written to or created.
void requireWritable(const std::filesystem::path &folder);

} // namespace pellucid::files
