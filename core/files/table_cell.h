// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::files {

/// A text from outside as a cell of a table. It is one line without tabs, and a spreadsheet shows
/// it: an apostrophe before a text that begins as a formula does keeps it from being run. Numbers
/// stay numbers, also several with backslashes between them, as DICOM writes them.
std::string tableCell(const std::string &text);

/// A cell as a field of a table with tabs, as on the clipboard: in quotes if it has any, because
/// spreadsheets take them for the ends of a field.
std::string tabbedField(const std::string &cell);

/// A cell as a field of CSV, in quotes. *Source*: RFC 4180.
std::string csvField(const std::string &cell);

} // namespace pellucid::files
