// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_lock.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>

namespace pellucid::files {

FileLock::FileLock(const std::filesystem::path &file)
    : m_file(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    while (m_file && ::flock(m_file.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
}

} // namespace pellucid::files
