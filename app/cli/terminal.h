// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace pellucid::cli {

/// Makes untrusted text, such as names of files and patients, safe to print: one line of UTF-8
/// without control characters, line breaks and changes of direction.
std::string printable(const std::string &text);

/// Escapes, within strings of JSON, the characters beyond C0 that control a terminal. JSON itself
/// escapes C0.
std::string escapedControls(const std::string &json);

/// "1 image", "2 images"; for nouns with a regular plural.
std::string counted(std::size_t count, const std::string &noun);

/// Prints a warning on stderr, one line.
void warn(const std::string &what);

} // namespace pellucid::cli
