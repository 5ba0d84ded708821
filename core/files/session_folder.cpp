// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/session_folder.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <string>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;

std::optional<fs::path> sessionsFolder() {
    const auto cache = userCacheFolder();
    return cache ? std::optional(*cache / "sessions") : std::nullopt;
}

fs::path lockOf(const fs::path &folder) {
    return folder.string() + ".lock";
}

// The lock if nobody else holds it; -1. The system lets go of it when a program ends, however.
int takeLock(const fs::path &lock, int flags) {
    const int fd = ::open(lock.c_str(), O_RDWR | O_CLOEXEC | flags, 0600);
    if (fd >= 0 && ::flock(fd, LOCK_EX | LOCK_NB) == 0)
        return fd;
    if (fd >= 0)
        ::close(fd);
    return -1;
}

} // namespace

SessionFolder::SessionFolder() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        throw task::Error(task::ErrorCode::output, "there is no folder for temporary files");
    make(*sessions);
}

SessionFolder::SessionFolder(const fs::path &parent) {
    make(parent);
}

void SessionFolder::make(const fs::path &parent) {
    std::error_code failed;
    fs::create_directories(parent, failed);
    std::string name = (parent / "XXXXXX").string();
    // Made for the user alone.
    if (mkdtemp(name.data()) == nullptr)
        throw task::Error(task::ErrorCode::output, std::strerror(errno), parent);
    m_path = name;
    m_lock = takeLock(lockOf(m_path), O_CREAT);
}

SessionFolder::~SessionFolder() {
    std::error_code failed, ignored;
    fs::remove_all(m_path, failed);
    if (!failed) // else the next program tries again
        fs::remove(lockOf(m_path), ignored);
    if (m_lock >= 0)
        ::close(m_lock);
}

bool isInSessionFolder(const fs::path &path) {
    const auto sessions = sessionsFolder();
    return sessions && path.string().starts_with(sessions->string() + "/");
}

void removeAbandonedSessionFolders() {
    if (const auto sessions = sessionsFolder())
        removeAbandonedSessionFolders(*sessions);
}

void removeAbandonedSessionFolders(const fs::path &parent,
                                   const std::function<void(const fs::path &)> &before) {
    std::error_code failed;
    for (fs::directory_iterator entry(parent, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        std::error_code ignored;
        if (!entry->is_directory(ignored))
            continue;
        // One that is just being made has no lock yet: it is no minute old.
        const auto made = fs::last_write_time(entry->path(), ignored);
        const bool isNew = fs::file_time_type::clock::now() - made < std::chrono::minutes(1);
        const int lock = takeLock(lockOf(entry->path()), 0);
        if (lock < 0 && (isNew || fs::exists(lockOf(entry->path()), ignored)))
            continue;
        if (before)
            before(entry->path());
        std::error_code kept;
        fs::remove_all(entry->path(), kept);
        if (!kept)
            fs::remove(lockOf(entry->path()), ignored);
        if (lock >= 0)
            ::close(lock);
    }
}

} // namespace pellucid::files
