// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/new_file.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sys/random.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/platform/handle.h"

namespace pellucid::platform {

namespace {

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

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
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
    if (descriptor >= 0 &&
        ::access(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), F_OK) == 0)
        return descriptor;
    if (descriptor >= 0)
        ::close(descriptor);
    return -1;
}

} // namespace

NewFile::NewFile(const std::filesystem::path &path, Readers readers)
    : m_mode(readers == Readers::user ? 0600 : 0666 & ~currentMask()) {
    int descriptor = openNameless(path.parent_path(), m_mode);
    if (descriptor < 0) {
        std::string name = hiddenNameFor(path);
        descriptor = ::mkstemp(name.data());
        if (descriptor < 0)
            fail(errno);
        m_temporary = name;
        ::fchmod(descriptor, m_mode); // mkstemp creates private files
    }
    m_file = ::fdopen(descriptor, "wb");
    if (m_file == nullptr) {
        const int error = errno;
        ::close(descriptor);
        if (!m_temporary.empty())
            ::unlink(m_temporary.c_str());
        fail(error);
    }
}

NewFile::~NewFile() {
    if (m_file != nullptr)
        std::fclose(m_file);
    if (!m_temporary.empty())
        ::unlink(m_temporary.c_str());
}

HandleView NewFile::view() const {
    return HandleView(::fileno(m_file));
}

std::filesystem::path NewFile::currentPath() const {
    return "/proc/self/fd/" + std::to_string(view().get());
}

// Links a nameless file to its path, or to a hidden name if the path exists, because a link
// replaces nothing.
void NewFile::link(const std::filesystem::path &path) {
    const std::filesystem::path self = currentPath();
    const auto linkTo = [&](const std::filesystem::path &name) {
        return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (linkTo(path))
        return;
    // A kill between here and the rename leaves the hidden file behind, so nothing else happens in
    // between.
    int error = errno;
    while (error == EEXIST) {
        unsigned number = 0;
        (void)!::getrandom(&number, sizeof number, 0);
        const std::string name = hiddenNameFor(path, std::to_string(number));
        if (linkTo(name)) {
            m_temporary = name;
            return;
        }
        error = errno;
    }
    // Some file systems have nameless files that cannot be linked.
    if (error == ENOSPC || error == EDQUOT)
        fail(error);
    m_temporary = copyTo(hiddenNameFor(path));
}

// Copies the bytes to a file with a name.
std::string NewFile::copyTo(std::string name) const {
    const Handle copy(::mkstemp(name.data()));
    if (!copy)
        fail(errno);
    try {
        const off_t end = ::lseek(view().get(), 0, SEEK_END);
        if (copyStart(view(), copy, std::uint64_t(end)) != std::uint64_t(end))
            fail(EIO);
        if (::fchmod(copy.get(), m_mode) != 0 || ::fsync(copy.get()) != 0)
            fail(errno);
    } catch (const std::system_error &) {
        ::unlink(name.c_str());
        throw;
    }
    return name;
}

void NewFile::publish(const std::filesystem::path &path, bool mustLast) {
    if (std::fflush(m_file) != 0 || (mustLast && ::fsync(view().get()) != 0))
        fail(errno);
    // All bytes are on the disk, or will be with the folder. A network share may refuse to rename
    // an open file; a nameless file is lost when it is closed.
    if (m_temporary.empty())
        link(path);
    std::fclose(m_file);
    m_file = nullptr;
    if (!m_temporary.empty() && std::rename(m_temporary.c_str(), path.c_str()) != 0)
        fail(errno);
    m_temporary.clear();
}

std::uint64_t copyStart(HandleView from, HandleView to, std::uint64_t bytes) {
    off_t at = 0;
    for (ssize_t copied = 1; std::uint64_t(at) < bytes && copied > 0;) {
        do
            copied = ::sendfile(to.get(), from.get(), &at, std::size_t(bytes - std::uint64_t(at)));
        while (copied < 0 && errno == EINTR);
        if (copied < 0)
            fail(errno);
    }
    return std::uint64_t(at);
}

void renameFlushed(const std::filesystem::path &from, const std::filesystem::path &to) {
    const Handle file(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file || ::fsync(file.get()) != 0 || std::rename(from.c_str(), to.c_str()) != 0)
        fail(errno);
}

void flushFolder(const std::filesystem::path &folder) {
    const Handle opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!opened || ::syncfs(opened.get()) != 0)
        fail(errno);
}

void requireWritable(const std::filesystem::path &folder) {
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        fail(errno);
}

// The kernel's rule against links (fs.protected_symlinks) holds for who opens a link, not for who
// reads it.
bool isForeignLink(const std::filesystem::path &link) {
    constexpr mode_t shared = S_ISVTX | S_IWOTH;
    struct stat own {};
    struct stat folder {};
    const std::filesystem::path parent = link.has_parent_path() ? link.parent_path() : ".";
    if (::lstat(link.c_str(), &own) != 0 || ::stat(parent.c_str(), &folder) != 0)
        fail(errno);
    return (folder.st_mode & shared) == shared && own.st_uid != ::geteuid() &&
           own.st_uid != folder.st_uid;
}

} // namespace pellucid::platform
