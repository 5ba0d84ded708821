// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

namespace pellucid::platform {

/// The character sets that are read, by their IANA names; EUC-JP with JIS X 0212.
inline constexpr std::array characterSets{"ISO-8859-1", "ISO-8859-2",  "ISO-8859-3", "ISO-8859-4",
                                          "ISO-8859-5", "ISO-8859-6",  "ISO-8859-7", "ISO-8859-8",
                                          "ISO-8859-9", "ISO-8859-15", "TIS-620",    "EUC-JP",
                                          "EUC-KR",     "GB2312",      "GBK",        "GB18030"};

/// Converts to UTF-8. A byte that begins no valid character becomes a question mark, and reading
/// continues with the next one. *Requires*: one of `characterSets`.
std::string utf8Of(const std::string &bytes, const std::string &characterSet);

/// Opens the tables of all character sets, which are files, for good: a confined process cannot.
void openCharacterTables();

} // namespace pellucid::platform
