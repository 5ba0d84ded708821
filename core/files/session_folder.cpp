// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/session_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <optional>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/files/reasons.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".pellucid-", pattern = ".pellucid-XXXXXX";
constexpr const char *lockName = ".lock", *contentsName = "files";

std::optional<fs::path> sessionsFolder() {
    const auto cache = userCacheFolder();
    return cache ? std::optional(*cache / "sessions") : std::nullopt;
}

// What the lock contains. Locks may hold on one machine only, so it names the machine.
const std::string &mark() {
    static const std::string text = [] {
        std::array<char, 256> host{};
        ::gethostname(host.data(), host.size() - 1);
        return std::string("Pellucid session folder on ") + host.data() + "\n";
    }();
    return text;
}

// The path of an open file or folder, whatever becomes of its name.
fs::path pathOf(const platform::Handle &open) {
    return "/proc/self/fd/" + std::to_string(open.get());
}

platform::Handle openFolder(int parent, const std::string &name, int flags) {
    return platform::Handle(
        ::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | flags));
}

// Creates the lock of a new folder and takes it. Empty, with errno, if that fails; with ENOENT if a
// cleanup was faster.
platform::Handle makeLock(int folder) {
    platform::Handle lock(
        ::openat(folder, lockName, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    // On a network share without locks, nobody can lock the file, so nobody will clean up there.
    while (lock && ::flock(lock.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat about {};
    if (!lock || ::fstat(lock.get(), &about) != 0)
        return platform::Handle();
    errno = ENOENT;
    const bool isMade = about.st_nlink > 0 &&
                        ::write(lock.get(), mark().data(), mark().size()) == ssize_t(mark().size());
    return isMade ? std::move(lock) : platform::Handle();
}

bool isOwn(const struct stat &about) {
    return about.st_uid == ::geteuid() && (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

// Removes the contents, then the lock, so that a program that is killed meanwhile leaves a folder
// with a mark. Closes the lock first: on NFS, an open file keeps its folder.
void remove(int parent, const std::string &name, const platform::Handle &folder,
            platform::Handle lock) {
    std::error_code failed, kept;
    for (fs::directory_iterator entry(pathOf(folder), failed), end;
         !failed && !kept && entry != end; entry.increment(failed))
        if (entry->path().filename() != lockName)
            fs::remove_all(entry->path(), kept);
    lock = platform::Handle();
    if (!failed && !kept && ::unlinkat(folder.get(), lockName, 0) == 0)
        ::unlinkat(parent, name.c_str(), AT_REMOVEDIR);
}

// Removes a folder if a program of this user has made it on this machine and has ended.
void removeIfAbandoned(int parent, const std::string &name,
                       const std::function<void(const fs::path &)> &before) {
    const platform::Handle folder = openFolder(parent, name, O_NOFOLLOW);
    struct stat about {};
    if (!folder || ::fstat(folder.get(), &about) != 0 || !isOwn(about))
        return;
    platform::Handle lock(
        ::openat(folder.get(), lockName, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!lock) {
        ::unlinkat(parent, name.c_str(), AT_REMOVEDIR); // if it is empty
        return;
    }
    if (::fstat(lock.get(), &about) != 0 || !S_ISREG(about.st_mode) || !isOwn(about) ||
        ::flock(lock.get(), LOCK_EX | LOCK_NB) != 0)
        return;
    std::string text(mark().size() + 1, '\0');
    text.resize(
        std::size_t(std::max(::pread(lock.get(), text.data(), text.size(), 0), ssize_t(0))));
    if (text == mark()) {
        if (before)
            before(pathOf(folder) / contentsName);
        remove(parent, name, folder, std::move(lock));
    } else if (text.empty()) { // killed when it had just begun
        ::unlinkat(folder.get(), lockName, 0);
        ::unlinkat(parent, name.c_str(), AT_REMOVEDIR);
    }
}

fs::path sessionsOfUser() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        throw task::Error(task::ErrorCode::output, task::because::noTemporaryFolder);
    return *sessions;
}

} // namespace

SessionFolder::SessionFolder() : SessionFolder(sessionsOfUser()) {}

SessionFolder::SessionFolder(const fs::path &parent) : SessionFolder(parent, Path::byName) {}

SessionFolder SessionFolder::in(const fs::path &folder) {
    return {folder.empty() ? "." : folder, Path::byDescriptor};
}

SessionFolder SessionFolder::beside(const fs::path &file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    removeAbandonedSessionFolders(folder);
    return in(folder);
}

SessionFolder::SessionFolder(const fs::path &parent, Path path) : m_naming(path) {
    int error = 0;
    for (int attempts = 0; attempts < 100; ++attempts) {
        if (m_naming == Path::byName)
            createPrivateFolders(parent);
        m_parent = openFolder(AT_FDCWD, parent.string(), O_PATH);
        std::string made = (pathOf(m_parent) / pattern).string();
        const bool isMade = m_parent && ::mkdtemp(made.data()) != nullptr; // private to the user
        error = errno;
        if (isMade) {
            m_name = fs::path(made).filename();
            m_folder = openFolder(m_parent.get(), m_name, O_NOFOLLOW);
            m_lock = m_folder ? makeLock(m_folder.get()) : platform::Handle();
            if (m_lock && ::mkdirat(m_folder.get(), contentsName, 0700) == 0)
                m_contents = openFolder(m_folder.get(), contentsName, O_NOFOLLOW);
            error = errno;
        }
        if (m_contents) {
            m_path = m_naming == Path::byName ? parent / m_name / contentsName : pathOf(m_contents);
            return;
        }
        m_lock = platform::Handle();
        if (isMade)
            removeIfAbandoned(m_parent.get(), m_name, {});
        // Another program's cleanup was faster, or has removed the empty parent.
        if (error != ENOENT || (m_naming == Path::byDescriptor && !isMade))
            break;
    }
    throw task::Error(task::ErrorCode::output, task::systemReason(error), parent);
}

SessionFolder::~SessionFolder() {
    if (m_isAbandoned)
        return;
    remove(m_parent.get(), m_name, m_folder,
           std::move(m_lock)); // else the next program tries again
    std::error_code ignored;
    if (m_naming == Path::byName)
        fs::remove(m_path.parent_path().parent_path(), ignored); // if it is empty
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
    const platform::Handle opened = openFolder(AT_FDCWD, parent.string(), 0);
    if (!opened)
        return;
    std::error_code failed;
    for (fs::directory_iterator entry(pathOf(opened), failed), end; !failed && entry != end;
         entry.increment(failed))
        if (const std::string name = entry->path().filename();
            name.size() == pattern.size() && name.starts_with(prefix))
            removeIfAbandoned(opened.get(), name, before);
}

} // namespace pellucid::files
