// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/session_folder.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <optional>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;

constexpr const char *unfinished = ".pellucid-unfinished";

std::optional<fs::path> sessionsFolder() {
    const auto cache = userCacheFolder();
    return cache ? std::optional(*cache / "sessions") : std::nullopt;
}

fs::path lockOf(const fs::path &folder) {
    return folder.string() + ".lock";
}

// Locks a file unless another program holds the lock. The system releases it when the program ends,
// however that happens.
Descriptor takeLock(const fs::path &lock) {
    Descriptor file(::open(lock.c_str(), O_RDWR | O_CLOEXEC));
    struct stat about {};
    // A lock file that was removed meanwhile locks nothing.
    if (file && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 && ::fstat(file.get(), &about) == 0 &&
        about.st_nlink > 0)
        return file;
    return Descriptor();
}

// For a network share without locks: nobody can lock the file, so nobody will clean up there.
Descriptor takeLockOrFile(const fs::path &lock) {
    Descriptor taken = takeLock(lock);
    if (!taken && (errno == ENOLCK || errno == EOPNOTSUPP || errno == ENOSYS))
        return Descriptor(::open(lock.c_str(), O_RDWR | O_CLOEXEC));
    return taken;
}

} // namespace

SessionFolder::SessionFolder() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        throw task::Error(task::ErrorCode::output, task::because::noTemporaryFolder);
    make(*sessions);
}

SessionFolder::SessionFolder(const fs::path &parent, Parent then) : m_parent(then) {
    make(parent);
}

void SessionFolder::make(const fs::path &parent) {
    std::error_code failed;
    fs::create_directories(parent, failed);
    // The lock comes first: no folder exists without the lock of its program.
    for (int attempts = 0; attempts < 100; ++attempts) {
        std::string name = (parent / "XXXXXX.lock").string();
        const Descriptor made(::mkstemps(name.data(), int(std::string_view(".lock").size())));
        if (!made && errno == ENOENT) {             // an empty parent was removed meanwhile
            fs::create_directories(parent, failed); // perhaps by another program
            if (!failed)
                continue;
        }
        if (!made)
            break;
        m_lock = takeLockOrFile(name);
        if (!m_lock) // a cleanup was faster
            continue;
        m_path = name.substr(0, name.rfind('.'));
        if (::mkdir(m_path.c_str(), 0700) == 0) // private to the user
            return;
        const int error = errno;
        ::unlink(name.c_str());
        errno = error;
        if (error != EEXIST)
            break;
    }
    throw task::Error(task::ErrorCode::output, task::systemReason(errno), parent);
}

SessionFolder::~SessionFolder() {
    if (m_isAbandoned)
        return;
    std::error_code failed, ignored;
    fs::remove_all(m_path, failed);
    if (!failed) // otherwise the next program tries again
        fs::remove(lockOf(m_path), ignored);
    if (m_parent == Parent::goes)
        fs::remove(m_path.parent_path(), ignored); // if it is empty
}

SessionFolder SessionFolder::beside(const fs::path &file) {
    std::error_code unknown;
    const fs::path parent = fs::absolute(file, unknown).parent_path() / unfinished;
    removeAbandonedSessionFolders(parent);
    return SessionFolder(parent, Parent::goes);
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
        const fs::path &lockFile = entry->path();
        if (lockFile.extension() != ".lock")
            continue;
        const Descriptor lock = takeLock(lockFile);
        if (!lock)
            continue;
        fs::path folder = lockFile;
        folder.replace_extension();
        if (before)
            before(folder);
        std::error_code kept, ignored;
        fs::remove_all(folder, kept);
        if (!kept)
            fs::remove(lockFile, ignored);
    }
}

} // namespace pellucid::files
