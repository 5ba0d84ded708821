// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/atomic_file.h"

#include <cerrno>
#include <system_error>

#include "core/files/reasons.h"
#include "core/platform/file.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::files {

namespace {

using platform::pathByName;

[[noreturn]] void fail(const std::error_code &error, const std::filesystem::path &path) {
    throw task::Error(task::ErrorCode::output,
                      task::because::cannotBeWritten(task::systemReason(error)), path);
}

// Does what may throw std::system_error, which then names the path.
template <class Work> auto orFail(const std::filesystem::path &path, const Work &work) {
    try {
        return work();
    } catch (const std::system_error &error) {
        fail(error.code(), path);
    }
}

} // namespace

void requireTrusted(const std::filesystem::path &link) {
    bool isForeign = false;
    try {
        isForeign = platform::isForeignLink(link);
    } catch (const std::system_error &error) {
        throw task::Error(task::ErrorCode::output, task::systemReason(error.code()), link);
    }
    if (isForeign)
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
    : m_path(targetOf(path)), m_file(orFail(pathByName(m_path), [&] {
          return std::make_unique<platform::NewFile>(m_path, readers);
      })) {}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), m_file->stream()) != bytes.size())
        failWith(errno);
}

void AtomicFile::write(platform::HandleView file, std::uint64_t bytes) {
    const std::uint64_t copied =
        orFail(pathByName(m_path), [&] { return platform::copyStart(file, view(), bytes); });
    if (copied != bytes) // it ends before
        throw task::Error(task::ErrorCode::unusable, task::because::isTruncated);
}

platform::HandleView AtomicFile::view() const {
    if (std::fflush(m_file->stream()) != 0)
        failWith(errno);
    return m_file->view();
}

std::filesystem::path AtomicFile::currentPath() const {
    return m_file->currentPath();
}

void AtomicFile::commit(Bytes bytes) {
    orFail(pathByName(m_path), [&] { m_file->publish(m_path, bytes == Bytes::flushed); });
}

void AtomicFile::failWith(int error) const {
    fail({error, std::generic_category()}, pathByName(m_path));
}

void rename(const std::filesystem::path &from, const std::filesystem::path &to) {
    orFail(to, [&] { platform::renameFlushed(from, to); });
}

void flush(const std::filesystem::path &folder) {
    orFail(folder, [&] { platform::flushFolder(folder); });
}

void requireWritable(const std::filesystem::path &folder) {
    std::error_code unknown;
    std::filesystem::path there =
        std::filesystem::weakly_canonical(std::filesystem::absolute(folder, unknown), unknown);
    while (!std::filesystem::exists(there, unknown) && there.has_relative_path())
        there = there.parent_path();
    if (!std::filesystem::is_directory(there, unknown))
        throw task::Error(task::ErrorCode::output, task::because::isNoFolder, there);
    orFail(there, [&] { platform::requireWritable(there); });
}

} // namespace pellucid::files
