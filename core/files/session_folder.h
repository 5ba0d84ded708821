// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "core/files/descriptor.h"

namespace pellucid::files {

/// A private folder for what a running program unpacks or has not finished, gone with the object.
/// The program holds a lock beside it as long as it runs, so that what a killed program left is
/// found by `removeAbandonedSessionFolders`.
class SessionFolder {
public:
    /// Below the user's cache. *Throws* Error{output} if there is no place for it.
    SessionFolder();
    /// Below a folder, which is made; one that `goes` is removed with the last one in there.
    /// *Throws* Error{output}.
    enum class Parent { stays, goes };
    explicit SessionFolder(const std::filesystem::path &parent, Parent then = Parent::stays);
    /// On the same file system as a file that is to be written: in a hidden folder next to it,
    /// which is removed with the last one in there. What killed programs left there goes first.
    /// *Throws* Error{output}.
    static SessionFolder beside(const std::filesystem::path &file);
    ~SessionFolder();
    SessionFolder(const SessionFolder &) = delete;
    SessionFolder &operator=(const SessionFolder &) = delete;

    const std::filesystem::path &path() const { return m_path; }
    /// What is in it is for the next program that removes abandoned folders, unless it is taken
    /// back.
    void setLeft(bool isLeft) { m_isLeft = isLeft; }

private:
    void make(const std::filesystem::path &parent);

    std::filesystem::path m_path;
    Descriptor m_lock;
    Parent m_parent = Parent::stays;
    bool m_isLeft = false;
};

/// Whether a file is in a folder below the user's cache that will be gone with a program that runs.
bool isInSessionFolder(const std::filesystem::path &path);

/// Removes the folders of programs that no longer run, below the user's cache.
void removeAbandonedSessionFolders();
/// Below a folder; `before` is given each while it is still there.
void removeAbandonedSessionFolders(
    const std::filesystem::path &parent,
    const std::function<void(const std::filesystem::path &)> &before = {});

} // namespace pellucid::files
