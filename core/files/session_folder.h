// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "core/platform/marked_folder.h"

namespace pellucid::files {

/// A private folder for files that a running program unpacks or has not finished. It is removed
/// with the object. A lock inside marks it, so that `removeAbandonedSessionFolders` recognises the
/// folders of killed programs.
class SessionFolder {
public:
    /// Creates it in the user's cache. *Throws* Error{output} if that is impossible.
    SessionFolder();
    /// Creates it in `parent`, a folder of this user's, which is created if necessary and removed
    /// with its last session folder. *Throws* Error{output}.
    explicit SessionFolder(const std::filesystem::path &parent);
    /// Creates it in any folder that exists, to which others may write: `path` leads to it even if
    /// they rename it and put something else in its place. *Throws* Error{output}.
    static SessionFolder in(const std::filesystem::path &folder);
    /// The same next to an output file, on the same file system. First removes abandoned folders
    /// there. *Throws* Error{output}.
    static SessionFolder beside(const std::filesystem::path &file);
    ~SessionFolder();
    SessionFolder(const SessionFolder &) = delete;
    SessionFolder &operator=(const SessionFolder &) = delete;

    const std::filesystem::path &path() const { return m_folder.path(); }
    const platform::MarkedFolder &marked() const { return m_folder; }
    /// If set, the folder stays and is removed as an abandoned one by the next program.
    void setAbandoned(bool isAbandoned);

private:
    SessionFolder(const std::filesystem::path &parent, platform::MarkedFolder::Path path);

    platform::MarkedFolder::Path m_path;
    platform::MarkedFolder m_folder;
    bool m_isAbandoned = false;
};

/// Whether a file is in a session folder of the user's cache, which will be removed.
bool isInSessionFolder(const std::filesystem::path &path);

/// Removes the session folders of programs that no longer run from the user's cache.
void removeAbandonedSessionFolders();
/// The same in `parent`; `before` is called with each folder before it is removed. Removes only
/// what this user's programs on this machine have made: anybody may have put other folders, or
/// links, of such names there.
void removeAbandonedSessionFolders(
    const std::filesystem::path &parent,
    const std::function<void(const std::filesystem::path &)> &before = {});

} // namespace pellucid::files
