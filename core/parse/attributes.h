// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/parse/character_sets.h"

class DcmItem;
class DcmTagKey;

namespace pellucid::parse {

// The values of single attributes: what is missing or damaged is empty. An item may be null.

/// A text as `oneLine` leaves it. *Shape*: `sets`: of a text that may have letters beyond ASCII.
std::string readText(DcmItem *item, const DcmTagKey &tag, const CharacterSets *sets = nullptr);
/// All values up to the first that is no number, whatever the attribute's type.
std::vector<double> readNumbers(DcmItem *item, const DcmTagKey &tag, std::size_t most = 64);
/// The first value, if it is a number: all of it, since half of one, as of "2,5", is another.
std::optional<double> readNumber(DcmItem *item, const DcmTagKey &tag);
/// The first value without its fraction, if it is a number of 32 bits.
int readInteger(DcmItem *item, const DcmTagKey &tag, int otherwise = 0);
/// The first item of a sequence.
DcmItem *sequenceItem(DcmItem *item, const DcmTagKey &tag);

/// A text of at most 1024 bytes, its control characters replaced by spaces, without those at its
/// end.
std::string oneLine(std::string text);

} // namespace pellucid::parse
