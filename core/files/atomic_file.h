// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace pellucid::files {

/// The file that is meant where something is written: through a link, what it points at. *Throws*
/// Error{output} where a device or a pipe would become a file.
std::filesystem::path targetOf(const std::filesystem::path &path);

/// A file that appears under its name only when it is complete: until `commit` has flushed it to
/// the disk its bytes are in a file without a name, which is gone with a program that is killed; on
/// file systems without such files, in a hidden one in the same folder.
class AtomicFile {
public:
    /// *Throws* Error{output} if the folder cannot be written.
    explicit AtomicFile(const std::filesystem::path &path);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// *Throws* Error{output}, for instance when the disk is full.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
    /// *Throws* Error{output}; the former file of that name, if any, is then untouched.
    void commit();

private:
    [[noreturn]] void fail(int error) const;
    void takeName();
    std::string copyUnder(std::string name);

    std::filesystem::path m_path;
    std::filesystem::path m_temporary; ///< empty if it has no name
    std::FILE *m_file = nullptr;
};

/// Gives a finished file its name, on the same file system, when its bytes are on the disk.
/// *Throws* Error{output}; what was there is then untouched.
void rename(const std::filesystem::path &from, const std::filesystem::path &to);

/// Has everything that was written in a folder's file system on the disk. *Throws* Error{output}.
void flush(const std::filesystem::path &folder);

/// Looked at before long work begins: *throws* Error{output} with path and reason if nothing can be
/// made in a folder, or the folder itself cannot.
void requireWritable(const std::filesystem::path &folder);

} // namespace pellucid::files
