// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace pellucid::platform {

namespace {

// Repeats a call that a signal has interrupted. *Throws* std::system_error.
template <class Call> auto repeated(const Call &call) {
    for (;;) {
        const auto result = call();
        if (result >= 0)
            return result;
        if (errno != EINTR)
            throw std::system_error(errno, std::generic_category());
    }
}

} // namespace

Handle::~Handle() {
    if (m_native >= 0)
        ::close(m_native);
}

std::filesystem::path pathByName(const std::filesystem::path &path) {
    if (!path.string().starts_with("/proc/self/fd/"))
        return path;
    std::error_code unknown;
    const auto folder = std::filesystem::canonical(path.parent_path(), unknown);
    return unknown ? path : folder / path.filename();
}

int quotaExceeded() {
    return EDQUOT;
}

bool isSameName(const std::filesystem::path &a, const std::filesystem::path &b) {
    return a == b;
}

std::error_code listFolder(const std::filesystem::path &folder,
                           const std::function<void(const Entry &)> &take) {
    namespace fs = std::filesystem;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        take({it->path(),
              it->is_directory(ignored)      ? Entry::Kind::folder
              : it->is_regular_file(ignored) ? Entry::Kind::file
                                             : Entry::Kind::other,
              it->is_symlink(ignored)});
    }
    return error;
}

std::size_t longestStreamPath() {
    return 3000; // of PATH_MAX, which leaves room for the names of unfinished files
}

std::optional<FileId> fileIdOf(const std::filesystem::path &path) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0)
        return std::nullopt;
    return FileId{about.st_dev, about.st_ino};
}

FileFacts factsOf(const Handle &file) {
    struct stat about {};
    repeated([&] { return ::fstat(file.get(), &about); });
    return {bool(S_ISREG(about.st_mode)), std::uint64_t(about.st_size),
            std::int64_t(about.st_ctim.tv_sec) * 1'000'000'000 + about.st_ctim.tv_nsec};
}

Handle openForReading(const std::filesystem::path &path) {
    return Handle(repeated(
        [&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); }));
}

std::size_t readSome(HandleView file, std::span<std::byte> to) {
    std::size_t filled = 0;
    while (filled < to.size()) {
        const auto rest = to.subspan(filled);
        const auto got = repeated([&] { return ::read(file.get(), rest.data(), rest.size()); });
        if (got == 0)
            break;
        filled += std::size_t(got);
    }
    return filled;
}

std::size_t readAt(HandleView file, std::uint64_t from, std::span<std::byte> to) {
    return std::size_t(
        repeated([&] { return ::pread(file.get(), to.data(), to.size(), off_t(from)); }));
}

void writeAll(HandleView file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto written =
            repeated([&] { return ::write(file.get(), bytes.data(), bytes.size()); });
        if (written == 0)
            throw std::system_error(EIO, std::generic_category());
        bytes = bytes.subspan(std::size_t(written));
    }
}

Handle openOrCreate(const std::filesystem::path &path) {
    return Handle(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
}

bool lock(const Handle &file, Lock how) {
    try {
        repeated([&] {
            return ::flock(file.get(), how == Lock::attempt ? LOCK_EX | LOCK_NB : LOCK_EX);
        });
        return true;
    } catch (const std::system_error &error) {
        if (error.code().value() == EWOULDBLOCK)
            return false;
        throw;
    }
}

std::span<std::byte> map(HandleView file, std::size_t bytes, Access access) {
    const int may = access == Access::write ? PROT_READ | PROT_WRITE : PROT_READ;
    void *const data = ::mmap(nullptr, bytes, may, MAP_SHARED, file.get(), 0);
    if (data == MAP_FAILED)
        throw std::system_error(errno, std::generic_category());
    return {static_cast<std::byte *>(data), bytes};
}

void expectFewReads(std::span<const std::byte> mapped) {
    ::madvise(const_cast<std::byte *>(mapped.data()), mapped.size(), MADV_RANDOM);
}

void unmap(std::span<std::byte> mapped) {
    ::munmap(mapped.data(), mapped.size());
}

} // namespace pellucid::platform
