// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/dicom_text/character_sets.h"

class DcmItem;
class DcmTagKey;

namespace pellucid::dicom_text {

// The values of single attributes; missing or damaged values are empty. An item may be null.

/// A text, converted by `oneLine`. *Shape*: `sets`: for a text that may have letters beyond ASCII.
std::string readText(DcmItem *item, const DcmTagKey &tag, const CharacterSets *sets = nullptr);
/// All values up to the first that is not a number, whatever the attribute's type.
std::vector<double> readNumbers(DcmItem *item, const DcmTagKey &tag, std::size_t maxCount = 64);
/// The first value, if all of it is a number: a part, as of "2,5", is a different number.
std::optional<double> readNumber(DcmItem *item, const DcmTagKey &tag);
/// The first value without its fraction, if it is a 32-bit number.
int readInteger(DcmItem *item, const DcmTagKey &tag, int fallback = 0);
/// The first item of a sequence.
DcmItem *sequenceItem(DcmItem *item, const DcmTagKey &tag);

/// The number that all of a text is, but for padding.
std::optional<double> numberIn(std::string_view text);

/// A text of at most 1024 bytes, with control characters replaced by spaces and the last ones
/// removed.
std::string oneLine(std::string text);

} // namespace pellucid::dicom_text
