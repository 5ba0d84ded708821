// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/atomic_file.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <sys/random.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/files/reasons.h"
#include "core/platform/handle.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::files {

namespace {

// The leading dot hides an unfinished file from listings and folder scans.
std::string hiddenNameFor(const std::filesystem::path &path, const std::string &ending = "XXXXXX") {
    return (path.parent_path() / ("." + path.filename().string() + "." + ending)).string();
}

// Not by setting it: meanwhile, other threads would create files that anybody may write.
mode_t currentMask() {
    constexpr mode_t usual = 022;
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Umask:"))
            return mode_t(std::strtoul(line.c_str() + 6, nullptr, 8));
    return usual;
}

// A nameless file that can get a name later; -1 if the file system has none.
int openNameless(const std::filesystem::path &folder, mode_t mode) {
#ifdef O_TMPFILE
    const int descriptor =
        open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    if (descriptor >= 0 &&
        access(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), F_OK) == 0)
        return descriptor;
    if (descriptor >= 0)
        close(descriptor);
#endif
    return -1;
}

// The path by name of a file in a session folder, which is reached by its descriptor.
std::filesystem::path named(const std::filesystem::path &path) {
    std::error_code unknown;
    const auto folder = path.string().starts_with("/proc/self/fd/")
                            ? std::filesystem::canonical(path.parent_path(), unknown)
                            : path.parent_path();
    return unknown ? path : folder / path.filename();
}

// Copies the first bytes of an open file to the end of another one. Returns how many.
off_t copyBytes(int from, int to, off_t bytes) {
    off_t at = 0;
    for (ssize_t copied = 1; at < bytes && copied > 0;)
        do
            copied = sendfile(to, from, &at, std::size_t(bytes - at));
        while (copied < 0 && errno == EINTR);
    return at;
}

} // namespace

// The kernel's rule against links (fs.protected_symlinks) holds for who opens a link, not for who
// reads it.
void requireTrusted(const std::filesystem::path &link) {
    constexpr mode_t shared = S_ISVTX | S_IWOTH;
    struct stat own {};
    struct stat folder {};
    const std::filesystem::path parent = link.has_parent_path() ? link.parent_path() : ".";
    if (lstat(link.c_str(), &own) != 0 || stat(parent.c_str(), &folder) != 0)
        throw task::Error(task::ErrorCode::output, task::systemReason(errno), link);
    if ((folder.st_mode & shared) == shared && own.st_uid != geteuid() &&
        own.st_uid != folder.st_uid)
        throw task::Error(task::ErrorCode::output, task::because::isALinkOfAnotherUser, link);
}

std::filesystem::path targetOf(const std::filesystem::path &path) {
    constexpr int maxLinks = 40; // as the kernel
    std::filesystem::path meant = path;
    std::error_code unknown;
    for (int n = 0; std::filesystem::is_symlink(meant, unknown); ++n) {
        if (n == maxLinks)
            throw task::Error(task::ErrorCode::output, task::systemReason(ELOOP), path);
        requireTrusted(meant);
        meant = meant.parent_path() / std::filesystem::read_symlink(meant, unknown);
    }
    if (std::filesystem::exists(meant, unknown) &&
        !std::filesystem::is_regular_file(meant, unknown) &&
        !std::filesystem::is_directory(meant, unknown))
        throw task::Error(task::ErrorCode::output, task::because::isNotARegularFile, meant);
    return meant;
}

AtomicFile::AtomicFile(const std::filesystem::path &path, Readers readers)
    : m_path(targetOf(path)), m_mode(readers == Readers::user ? 0600 : 0666 & ~currentMask()) {
    int descriptor = openNameless(m_path.parent_path(), m_mode);
    if (descriptor < 0) {
        std::string name = hiddenNameFor(m_path);
        descriptor = mkstemp(name.data());
        if (descriptor < 0)
            fail(errno);
        m_temporary = name;
        fchmod(descriptor, m_mode); // mkstemp creates private files
    }
    m_file = fdopen(descriptor, "wb");
    if (m_file == nullptr) {
        const int error = errno;
        close(descriptor);
        if (!m_temporary.empty())
            unlink(m_temporary.c_str());
        fail(error);
    }
}

AtomicFile::~AtomicFile() {
    if (m_file != nullptr)
        std::fclose(m_file);
    if (!m_temporary.empty())
        unlink(m_temporary.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), m_file) != bytes.size())
        fail(errno);
}

// Links a nameless file to its path, or to a hidden name if the path exists, because a link
// replaces nothing.
void AtomicFile::linkToPath() {
    const std::string self = "/proc/self/fd/" + std::to_string(fileno(m_file));
    const auto link = [&](const std::filesystem::path &path) {
        return linkat(AT_FDCWD, self.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (link(m_path))
        return;
    // A kill between here and the rename leaves the hidden file behind, so nothing else happens in
    // between.
    int error = errno;
    while (error == EEXIST) {
        std::uint32_t number = 0;
        (void)!getrandom(&number, sizeof number, 0);
        const std::string name = hiddenNameFor(m_path, fmt::format("{:08x}", number));
        if (link(name)) {
            m_temporary = name;
            return;
        }
        error = errno;
    }
    // Some file systems have nameless files that cannot be linked.
    if (error == ENOSPC || error == EDQUOT)
        fail(error);
    m_temporary = copyTo(hiddenNameFor(m_path));
}

// Copies the bytes to a file with a name.
std::string AtomicFile::copyTo(std::string name) {
    const platform::Handle copy(mkstemp(name.data()));
    if (!copy)
        fail(errno);
    const off_t end = lseek(fileno(m_file), 0, SEEK_END);
    if (copyBytes(fileno(m_file), copy.get(), end) != end || fchmod(copy.get(), m_mode) != 0 ||
        fsync(copy.get()) != 0) {
        const int error = errno != 0 ? errno : EIO;
        unlink(name.c_str());
        fail(error);
    }
    return name;
}

void AtomicFile::write(int descriptor, std::uint64_t bytes) {
    if (std::fflush(m_file) != 0)
        fail(errno);
    errno = 0;
    if (copyBytes(descriptor, fileno(m_file), off_t(bytes)) != off_t(bytes)) {
        if (errno == 0) // it ends before
            throw task::Error(task::ErrorCode::unusable, task::because::isTruncated);
        fail(errno);
    }
}

int AtomicFile::descriptor() const {
    if (std::fflush(m_file) != 0)
        fail(errno);
    return fileno(m_file);
}

void AtomicFile::commit(Bytes bytes) {
    if (std::fflush(m_file) != 0 || (bytes == Bytes::flushed && fsync(fileno(m_file)) != 0))
        fail(errno);
    // All bytes are on the disk, or will be with the folder. A network share may refuse to rename
    // an open file; a nameless file is lost when it is closed.
    if (m_temporary.empty())
        linkToPath();
    std::fclose(m_file);
    m_file = nullptr;
    if (!m_temporary.empty() && std::rename(m_temporary.c_str(), m_path.c_str()) != 0)
        fail(errno);
    m_temporary.clear();
}

void AtomicFile::fail(int error) const {
    throw task::Error(task::ErrorCode::output,
                      task::because::cannotBeWritten(task::systemReason(error)), named(m_path));
}

void rename(const std::filesystem::path &from, const std::filesystem::path &to) {
    const platform::Handle file(open(from.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file || fsync(file.get()) != 0 || std::rename(from.c_str(), to.c_str()) != 0)
        throw task::Error(task::ErrorCode::output,
                          task::because::cannotBeWritten(task::systemReason(errno)), to);
}

void flush(const std::filesystem::path &folder) {
    const platform::Handle opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!opened || syncfs(opened.get()) != 0)
        throw task::Error(task::ErrorCode::output,
                          task::because::cannotBeWritten(task::systemReason(errno)), folder);
}

void requireWritable(const std::filesystem::path &folder) {
    std::error_code unknown;
    std::filesystem::path there =
        std::filesystem::weakly_canonical(std::filesystem::absolute(folder, unknown), unknown);
    while (!std::filesystem::exists(there, unknown) && there.has_relative_path())
        there = there.parent_path();
    if (!std::filesystem::is_directory(there, unknown))
        throw task::Error(task::ErrorCode::output, task::because::isNoFolder, there);
    if (access(there.c_str(), W_OK | X_OK) != 0)
        throw task::Error(task::ErrorCode::output,
                          task::because::cannotBeWritten(task::systemReason(errno)), there);
}

} // namespace pellucid::files
