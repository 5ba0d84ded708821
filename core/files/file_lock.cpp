// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_lock.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>

namespace pellucid::files {

FileLock::FileLock(const std::filesystem::path &file, Mode mode)
    : m_file(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    const int how = mode == Mode::tryLock ? LOCK_EX | LOCK_NB : LOCK_EX;
    int result = 0;
    while (m_file && (result = ::flock(m_file.get(), how)) != 0 && errno == EINTR) {
    }
    m_isHeld = result == 0 || errno != EWOULDBLOCK;
}

} // namespace pellucid::files
