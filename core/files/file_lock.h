// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/files/descriptor.h"

namespace pellucid::files {

/// Held by one program at a time, as long as the object is there; others wait for it, or do
/// without. Where a file cannot be locked (a share without locks, a folder that cannot be written)
/// nobody is kept out.
class FileLock {
public:
    enum class Mode { wait, tryLock };
    explicit FileLock(const std::filesystem::path &file, Mode mode = Mode::wait);
    /// False: another one holds it.
    bool isHeld() const { return m_isHeld; }

private:
    bool m_isHeld = true;
    Descriptor m_file;
};

} // namespace pellucid::files
