// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <stop_token>
#include <string>

#include "core/system/printable.h"

namespace pellucid::cli {

using system::printable;

/// Escapes, within strings of JSON, the characters beyond C0 that control a terminal or are hidden.
/// JSON itself escapes C0.
std::string escapedControls(const std::string &json);

/// "1 image", "2 images"; for nouns with a regular plural.
std::string counted(std::size_t count, const std::string &noun);

/// Reads a line from the terminal without showing it. *Throws* Error{usage} if there is no
/// terminal, Cancelled.
std::string askHidden(const std::string &question, const std::stop_token &stop);

/// Prints a warning on stderr, one line.
void warn(const std::string &what);

} // namespace pellucid::cli
