// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/atomic_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/task/error.h"

namespace pellucid::files {

AtomicFile::AtomicFile(std::filesystem::path path) : m_path(std::move(path)) {
    // Through a link to what it points at; and no device, pipe or folder becomes a file.
    std::error_code unknown;
    if (std::filesystem::is_symlink(m_path, unknown))
        if (const auto target = std::filesystem::weakly_canonical(m_path, unknown); !unknown)
            m_path = target;
    if (std::filesystem::exists(m_path, unknown) &&
        !std::filesystem::is_regular_file(m_path, unknown) &&
        !std::filesystem::is_directory(m_path, unknown))
        throw task::Error(task::ErrorCode::output, "is no regular file", m_path);
    // A dot in front keeps the unfinished file out of listings and of folder scans.
    std::string name =
        (m_path.parent_path() / ("." + m_path.filename().string() + ".XXXXXX")).string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0)
        fail(errno);
    m_temporary = name;
    // mkstemp makes files private; a finished result has the permissions of any new file.
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    m_file = fdopen(descriptor, "wb");
    if (m_file == nullptr) {
        const int error = errno;
        close(descriptor);
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

void AtomicFile::commit() {
    if (std::fflush(m_file) != 0 || fsync(fileno(m_file)) != 0)
        fail(errno);
    const int closed = std::fclose(m_file);
    m_file = nullptr;
    if (closed != 0)
        fail(errno);
    if (std::rename(m_temporary.c_str(), m_path.c_str()) != 0)
        fail(errno);
    m_temporary.clear();
}

void AtomicFile::fail(int error) const {
    throw task::Error(task::ErrorCode::output,
                      std::string("cannot be written: ") + std::strerror(error), m_path);
}

} // namespace pellucid::files
