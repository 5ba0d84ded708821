// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "core/files/descriptor.h"

namespace pellucid::files {

/// A private folder for files that a running program unpacks or has not finished. It is removed
/// with the object. The program holds a lock next to it, so that `removeAbandonedSessionFolders`
/// recognises the folders of killed programs.
class SessionFolder {
public:
    /// Creates it in the user's cache. *Throws* Error{output} if that is impossible.
    SessionFolder();
    /// Creates it in `parent`, which is created if necessary. A parent that `goes` is removed with
    /// its last session folder. *Throws* Error{output}.
    enum class Parent { stays, goes };
    explicit SessionFolder(const std::filesystem::path &parent, Parent then = Parent::stays);
    /// Creates it on the same file system as an output file: in a hidden folder next to the file,
    /// which is removed with its last session folder. First removes abandoned folders there.
    /// *Throws* Error{output}.
    static SessionFolder beside(const std::filesystem::path &file);
    ~SessionFolder();
    SessionFolder(const SessionFolder &) = delete;
    SessionFolder &operator=(const SessionFolder &) = delete;

    const std::filesystem::path &path() const { return m_path; }
    /// If set, the folder stays and is removed as an abandoned one by the next program.
    void setAbandoned(bool isAbandoned) { m_isAbandoned = isAbandoned; }

private:
    void make(const std::filesystem::path &parent);

    std::filesystem::path m_path;
    Descriptor m_lock;
    Parent m_parent = Parent::stays;
    bool m_isAbandoned = false;
};

/// Whether a file is in a session folder of the user's cache, which will be removed.
bool isInSessionFolder(const std::filesystem::path &path);

/// Removes the session folders of programs that no longer run from the user's cache.
void removeAbandonedSessionFolders();
/// The same below `parent`; `before` is called with each folder before it is removed.
void removeAbandonedSessionFolders(
    const std::filesystem::path &parent,
    const std::function<void(const std::filesystem::path &)> &before = {});

} // namespace pellucid::files
