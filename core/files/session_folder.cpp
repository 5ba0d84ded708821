// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/session_folder.h"

#include <optional>
#include <system_error>

#include "core/files/is_below.h"
#include "core/files/reasons.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;
using platform::MarkedFolder;

std::optional<fs::path> sessionsFolder() {
    const auto cache = userCacheFolder();
    return cache ? std::optional(*cache / "sessions") : std::nullopt;
}

fs::path sessionsOfUser() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        throw task::Error(task::ErrorCode::output, task::because::noTemporaryFolder);
    return *sessions;
}

} // namespace

SessionFolder::SessionFolder() : SessionFolder(sessionsOfUser()) {}

SessionFolder::SessionFolder(const fs::path &parent)
    : SessionFolder(parent, MarkedFolder::Path::byName) {}

SessionFolder SessionFolder::in(const fs::path &folder) {
    return {folder.empty() ? "." : folder, MarkedFolder::Path::byHandle};
}

SessionFolder SessionFolder::beside(const fs::path &file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    removeAbandonedSessionFolders(folder);
    return in(folder);
}

SessionFolder::SessionFolder(const fs::path &parent, MarkedFolder::Path path) : m_path(path) {
    std::error_code error;
    for (int attempts = 0; attempts < 100; ++attempts)
        try {
            if (m_path == MarkedFolder::Path::byName)
                createPrivateFolders(parent);
            m_folder = MarkedFolder(parent, m_path);
            return;
        } catch (const std::system_error &failure) {
            error = failure.code();
            // Another program's cleanup was faster, or has removed the empty parent.
            if (error != std::errc::resource_unavailable_try_again &&
                (error != std::errc::no_such_file_or_directory ||
                 m_path == MarkedFolder::Path::byHandle))
                break;
        }
    throw task::Error(task::ErrorCode::output, task::systemReason(error), parent);
}

SessionFolder::~SessionFolder() {
    if (m_isAbandoned)
        return;
    const fs::path parent = path().parent_path().parent_path();
    m_folder = MarkedFolder();
    std::error_code ignored;
    if (m_path == MarkedFolder::Path::byName)
        fs::remove(parent, ignored); // if it is empty
}

void SessionFolder::setAbandoned(bool isAbandoned) {
    m_isAbandoned = isAbandoned;
    m_folder.setAbandoned(isAbandoned);
}

bool isInSessionFolder(const fs::path &path) {
    const auto sessions = sessionsFolder();
    return sessions && isBelow(path, *sessions);
}

void removeAbandonedSessionFolders() {
    if (const auto sessions = sessionsFolder())
        removeAbandonedSessionFolders(*sessions);
}

void removeAbandonedSessionFolders(const fs::path &parent,
                                   const std::function<void(const fs::path &)> &before) {
    platform::removeAbandonedFolders(parent, before);
}

} // namespace pellucid::files
