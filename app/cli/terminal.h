// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::cli {

/// One line of UTF-8 without what a terminal obeys (control characters, ends of lines, changes of
/// direction): names of files and patients come from outside.
std::string printable(const std::string &text);

/// JSON escapes C0 by itself; the same for all else that steers a terminal, within strings.
std::string escapedControls(const std::string &json);

/// A line on stderr that keeps nothing from going on.
void warn(const std::string &what);

} // namespace pellucid::cli
