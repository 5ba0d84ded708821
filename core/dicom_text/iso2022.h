// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pellucid::dicom_text {

/// Whether all these terms of SpecificCharacterSet (PS3.3, C.12.1.1.2) can be read; empty ones can.
bool areKnown(const std::vector<std::string> &terms);

/// Converts a text in these character sets to UTF-8; invalid characters become question marks.
/// The characters of the first term need no designation. *Source*: PS3.5, 6.1.2.5 and annexes H to
/// K.
std::string utf8OfSets(std::string_view text, const std::vector<std::string> &terms);

} // namespace pellucid::dicom_text
