// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/marked_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace pellucid::platform {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".pellucid-", pattern = ".pellucid-XXXXXX";
constexpr const char *lockName = ".lock", *contentsName = "files";

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
fs::path pathOf(const Handle &open) {
    return "/proc/self/fd/" + std::to_string(open.get());
}

Handle openFolder(int parent, const std::string &name, int flags) {
    return Handle(::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | flags));
}

// Creates the lock of a new folder and takes it. Empty, with errno, if that fails; with ENOENT if a
// cleanup was faster.
Handle makeLock(int folder) {
    Handle lock(
        ::openat(folder, lockName, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    // On a network share without locks, nobody can lock the file, so nobody will clean up there.
    while (lock && ::flock(lock.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat about {};
    if (!lock || ::fstat(lock.get(), &about) != 0)
        return Handle();
    errno = ENOENT;
    const bool isMade = about.st_nlink > 0 &&
                        ::write(lock.get(), mark().data(), mark().size()) == ssize_t(mark().size());
    return isMade ? std::move(lock) : Handle();
}

bool isOwn(const struct stat &about) {
    return about.st_uid == ::geteuid() && (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

// Removes the contents, then the lock, so that a program that is killed meanwhile leaves a folder
// with a mark. Closes the lock first: on NFS, an open file keeps its folder.
void remove(int parent, const std::string &name, const Handle &folder, Handle lock) {
    std::error_code failed, kept;
    for (fs::directory_iterator entry(pathOf(folder), failed), end;
         !failed && !kept && entry != end; entry.increment(failed))
        if (entry->path().filename() != lockName)
            fs::remove_all(entry->path(), kept);
    lock = Handle();
    if (!failed && !kept && ::unlinkat(folder.get(), lockName, 0) == 0)
        ::unlinkat(parent, name.c_str(), AT_REMOVEDIR);
}

// Removes a folder if a program of this user has made it on this machine and has ended.
void removeIfAbandoned(int parent, const std::string &name,
                       const std::function<void(const fs::path &)> &before) {
    const Handle folder = openFolder(parent, name, O_NOFOLLOW);
    struct stat about {};
    if (!folder || ::fstat(folder.get(), &about) != 0 || !isOwn(about))
        return;
    Handle lock(::openat(folder.get(), lockName, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
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

} // namespace

MarkedFolder::MarkedFolder(const fs::path &parent, Path path) {
    m_parent = openFolder(AT_FDCWD, parent.string(), O_PATH);
    std::string made = (pathOf(m_parent) / pattern).string();
    if (!m_parent || ::mkdtemp(made.data()) == nullptr) // private to the user
        throw std::system_error(errno, std::generic_category());
    m_name = fs::path(made).filename();
    m_folder = openFolder(m_parent.get(), m_name, O_NOFOLLOW);
    m_lock = m_folder ? makeLock(m_folder.get()) : Handle();
    if (m_lock && ::mkdirat(m_folder.get(), contentsName, 0700) == 0)
        m_contents = openFolder(m_folder.get(), contentsName, O_NOFOLLOW);
    if (!m_contents) {
        const int error = errno;
        m_lock = Handle();
        removeIfAbandoned(m_parent.get(), m_name, {});
        throw std::system_error(error == ENOENT ? EAGAIN : error, std::generic_category());
    }
    m_path = path == Path::byName ? parent / m_name / contentsName : pathOf(m_contents);
}

MarkedFolder::~MarkedFolder() {
    if (m_contents && !m_isAbandoned)
        remove(m_parent.get(), m_name, m_folder,
               std::move(m_lock)); // else the next program tries again
}

MarkedFolder &MarkedFolder::operator=(MarkedFolder &&other) noexcept {
    std::swap(m_parent, other.m_parent);
    std::swap(m_folder, other.m_folder);
    std::swap(m_lock, other.m_lock);
    std::swap(m_contents, other.m_contents);
    std::swap(m_name, other.m_name);
    std::swap(m_path, other.m_path);
    std::swap(m_isAbandoned, other.m_isAbandoned);
    return *this;
}

void removeAbandonedFolders(const fs::path &parent,
                            const std::function<void(const fs::path &)> &before) {
    const Handle opened = openFolder(AT_FDCWD, parent.string(), 0);
    if (!opened)
        return;
    std::error_code failed;
    for (fs::directory_iterator entry(pathOf(opened), failed), end; !failed && entry != end;
         entry.increment(failed))
        if (const std::string name = entry->path().filename();
            name.size() == pattern.size() && name.starts_with(prefix))
            removeIfAbandoned(opened.get(), name, before);
}

} // namespace pellucid::platform
