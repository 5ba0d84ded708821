// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace pellucid {

/// Writes the log to a file that rotates at 1 MiB and keeps one predecessor. Failures to write are
/// ignored: the program works without a log.
void keepLogIn(const std::filesystem::path &file);

} // namespace pellucid
