// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace pellucid::parse {

/// Japanese text of DICOM (ISO 2022 IR 6, 13, 14, 87 and 159; PS3.5, annex H) as UTF-8. *Shape*:
/// with question marks for what is none.
std::string utf8OfJapanese(std::string_view text);

} // namespace pellucid::parse
