// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/platform/file.h"

namespace pellucid::files {

/// An open file, as it was when it was opened.
struct RegularFile {
    platform::Handle handle;
    platform::FileFacts facts;

    /// Whether nobody has changed it since. Callers ask after reading.
    bool isUnchanged() const;
};

/// Opens a file for reading. Does not block on a pipe or a device, even if the path has just become
/// one. *Throws* Error{unusable} with path and reason if it cannot be opened or is not a regular
/// file.
RegularFile openRegular(const std::filesystem::path &path);

} // namespace pellucid::files
