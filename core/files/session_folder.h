// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace pellucid::files {

/// A private folder for what a running program unpacks, gone with the object. It lies below the
/// user's cache, and the program holds a lock beside it as long as it runs, so that what a killed
/// program left is found by `removeAbandonedSessionFolders`.
class SessionFolder {
public:
    /// *Throws* Error{output} if there is no place for it.
    SessionFolder();
    ~SessionFolder();
    SessionFolder(const SessionFolder &) = delete;
    SessionFolder &operator=(const SessionFolder &) = delete;

    const std::filesystem::path &path() const { return m_path; }

private:
    std::filesystem::path m_path;
    int m_lock = -1;
};

/// Whether a file will be gone with a program that runs.
bool isInSessionFolder(const std::filesystem::path &path);

/// Removes the folders of programs that no longer run.
void removeAbandonedSessionFolders();

} // namespace pellucid::files
