// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace pellucid {

/// Sends the log to a file that turns over at a megabyte and keeps its predecessor. What cannot be
/// written is not: a log stops nobody's work.
void keepLogIn(const std::filesystem::path &file);

} // namespace pellucid
