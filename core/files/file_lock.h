// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/platform/file.h"

namespace pellucid::files {

/// A lock that one program at a time holds while the object exists; others wait for it or continue
/// without it. If a file cannot be locked (a network share without locks, a read-only folder),
/// nobody is excluded.
class FileLock {
public:
    using Mode = platform::Lock;
    explicit FileLock(const std::filesystem::path &file, Mode mode = Mode::wait);
    /// False if another program holds it.
    bool isHeld() const { return m_isHeld; }

private:
    bool m_isHeld = true;
    platform::Handle m_file;
};

} // namespace pellucid::files
