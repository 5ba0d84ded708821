// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_lock.h"

#include <system_error>

namespace pellucid::files {

FileLock::FileLock(const std::filesystem::path &file, Mode mode)
    : m_file(platform::openOrCreate(file)) {
    try {
        if (m_file)
            m_isHeld = platform::lock(m_file, mode);
    } catch (const std::system_error &) { // nobody can lock it
    }
}

} // namespace pellucid::files
