// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/printable.h"

#include <algorithm>
#include <array>

#include "core/system/utf8.h"

namespace pellucid::system {

namespace {

struct Range {
    char32_t first, last;
};
// Variation selectors, which tell apart the forms of a Chinese character, are visible.
constexpr std::array hidden{
    Range{0x00AD, 0x00AD},   // soft hyphen
    Range{0x034F, 0x034F},   // grapheme joiner
    Range{0x061C, 0x061C},   // Arabic letter mark
    Range{0x115F, 0x1160},   // Hangul fillers
    Range{0x17B4, 0x17B5},   // Khmer inherent vowels
    Range{0x180E, 0x180E},   // Mongolian vowel separator
    Range{0x200B, 0x200B},   // zero-width space
    Range{0x200E, 0x200F},   // direction marks
    Range{0x202A, 0x202E},   // embeddings and overrides of the direction
    Range{0x2060, 0x206F},   // word joiner, invisible operators, isolates, deprecated controls
    Range{0x2800, 0x2800},   // empty Braille pattern
    Range{0x3164, 0x3164},   // Hangul filler
    Range{0xFEFF, 0xFEFF},   // byte order mark
    Range{0xFFA0, 0xFFA0},   // halfwidth Hangul filler
    Range{0xFFF0, 0xFFFB},   // reserved, annotations
    Range{0x1BCA0, 0x1BCA3}, // controls of shorthand
    Range{0x1D173, 0x1D17A}, // controls of musical notation
    Range{0xE0000, 0xE00FF}, // tags
    Range{0xE01F0, 0xE0FFF}, // reserved
};

} // namespace

bool isControl(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029;
}

bool isHidden(char32_t c) {
    return std::any_of(hidden.begin(), hidden.end(),
                       [c](const Range &range) { return c >= range.first && c <= range.last; });
}

std::string printable(const std::string &text) {
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = codePointAt(text, at);
        if (point.bytes == 0)
            shown += '?';
        else if (isControl(point.code))
            shown += ' ';
        else if (!isHidden(point.code))
            shown.append(text, at, point.bytes);
        at += std::max<std::size_t>(1, point.bytes);
    }
    return shown;
}

} // namespace pellucid::system
