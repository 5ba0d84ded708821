// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/platform/handle.h"

namespace pellucid::platform {

/// A private folder for files that a running program unpacks or has not finished. It is removed
/// with the object. A lock inside marks it, so that `removeAbandonedFolders` recognises the folders
/// of killed programs.
class MarkedFolder {
public:
    MarkedFolder() = default;
    enum class Path {
        byName,
        byHandle ///< `path` leads to it even if others rename it and put something in its place
    };
    /// *Throws* std::system_error; errc::resource_unavailable_try_again if a cleanup was faster.
    MarkedFolder(const std::filesystem::path &parent, Path path);
    ~MarkedFolder();
    MarkedFolder(MarkedFolder &&other) noexcept = default;
    MarkedFolder &operator=(MarkedFolder &&other) noexcept;

    const std::filesystem::path &path() const { return m_path; }
    /// The open folder, for other programs, to which `path` may mean nothing.
    HandleView view() const { return m_contents; }
    /// If set, the folder stays and is removed as an abandoned one by the next program.
    void setAbandoned(bool isAbandoned) { m_isAbandoned = isAbandoned; }

private:
    Handle m_parent, m_folder, m_lock, m_contents;
    std::string m_name;
    std::filesystem::path m_path;
    bool m_isAbandoned = false;
};

/// Removes such folders in `parent` whose programs no longer run; `before` is called with the
/// contents of each before it is removed. Removes only what this user's programs on this machine
/// have made: anybody may have put other folders, or links, of such names there.
void removeAbandonedFolders(const std::filesystem::path &parent,
                            const std::function<void(const std::filesystem::path &)> &before);

} // namespace pellucid::platform
