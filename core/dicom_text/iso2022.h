// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace pellucid::dicom_text {

/// Whether texts of these character sets (the terms of SpecificCharacterSet) are converted here:
/// Japanese (ISO 2022 IR 13, 87, 159) and Latin 9 (203), which DCMTK leaves to an iconv that may
/// not know them, also in combination with other single-byte sets.
bool usesIso2022(const std::set<std::string> &terms);

/// Converts to UTF-8; invalid characters become question marks. *Source*: PS3.5, 6.1.2.5 and annex
/// H. `first`: the first term, whose characters need no designation; or empty.
std::string utf8OfIso2022(std::string_view text, const std::set<std::string> &terms,
                          const std::string &first);

/// Opens the tables of all character sets, which are files, for good: a confined process cannot.
void openCharacterTables();

} // namespace pellucid::dicom_text
