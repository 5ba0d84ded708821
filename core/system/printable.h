// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::system {

/// Control characters and the characters that separate lines.
bool isControl(char32_t c);

/// Characters that nobody sees: they change the direction of the text around them, or hide between
/// its letters. The two joiners are not among them, because names in Persian and in Indic scripts
/// need them.
bool isHidden(char32_t c);

/// Makes untrusted text, such as names of files and patients, safe to show: one line of UTF-8 that
/// looks like what it contains. Control characters and line breaks become blanks, hidden characters
/// vanish, and a byte that is not UTF-8 becomes '?'.
std::string printable(const std::string &text);

} // namespace pellucid::system
