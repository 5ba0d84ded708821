// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/platform/handle.h"

/// Writing files. All functions *throw* std::system_error.
namespace pellucid::platform {

/// Who may read a new file: those whom the user's file mode mask allows, or the user alone.
enum class Readers { usual, user };

/// A file that appears under a name only when it is complete. Until `publish`, its bytes are in a
/// nameless file, which disappears if the program is killed; on file systems without such files, in
/// a hidden file in the same folder.
class NewFile {
public:
    /// A file for the folder of `path`.
    NewFile(const std::filesystem::path &path, Readers readers);
    ~NewFile();
    NewFile(const NewFile &) = delete;
    NewFile &operator=(const NewFile &) = delete;

    std::FILE *stream() const { return m_file; }
    /// The open file.
    HandleView view() const;
    /// A path that leads to it now, as long as this program keeps it open. On Windows, it has a
    /// hidden name from then on, and stays if the program is killed.
    std::filesystem::path currentPath() const;
    /// Gives it a name on the same file system, in place of the file that has it. `mustLast`: its
    /// bytes are on the disk first.
    void publish(const std::filesystem::path &path, bool mustLast);

private:
    void link(const std::filesystem::path &path);
    std::string copyTo(std::string name) const;

    unsigned m_mode;
    std::filesystem::path m_temporary; ///< empty while it has no name
    std::FILE *m_file = nullptr;
    Handle m_shared; ///< the same file, where the right to delete it is kept from others
};

/// Copies the first bytes of an open file to the end of another one. Returns how many there were.
std::uint64_t copyStart(HandleView from, HandleView to, std::uint64_t bytes);

/// Renames a file after its bytes are on the disk.
void renameFlushed(const std::filesystem::path &from, const std::filesystem::path &to);
/// Flushes the file system of a folder to the disk.
void flushFolder(const std::filesystem::path &folder);
/// *Throws* if this user may not make files in a folder.
void requireWritable(const std::filesystem::path &folder);
/// Whether a link is of another user, in a folder where anybody may make links.
bool isForeignLink(const std::filesystem::path &link);

} // namespace pellucid::platform
