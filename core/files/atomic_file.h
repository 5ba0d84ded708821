// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>

namespace pellucid::files {

/// A file that appears under its name only when it is complete: bytes go to a temporary file in the
/// same folder, `commit` flushes it to the disk and renames it. Without commit nothing is left.
class AtomicFile {
public:
    /// *Throws* Error{output} if the folder cannot be written.
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// *Throws* Error{output}, for instance when the disk is full.
    void write(std::span<const std::byte> bytes);
    /// *Throws* Error{output}; the former file of that name, if any, is then untouched.
    void commit();

    /// Where the bytes go until commit, for writers that want a path of their own.
    const std::filesystem::path &temporaryPath() const { return m_temporary; }

private:
    [[noreturn]] void fail(int error) const;

    std::filesystem::path m_path;
    std::filesystem::path m_temporary;
    std::FILE *m_file = nullptr;
};

} // namespace pellucid::files
