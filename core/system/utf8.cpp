// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/utf8.h"

namespace pellucid::system {

CodePoint codePointAt(const std::string &text, std::size_t at) {
    const auto byte = [&](std::size_t n) {
        return at + n < text.size() ? (unsigned char)(text[at + n]) : 0U;
    };
    const unsigned first = byte(0);
    const std::size_t bytes = first < 0x80                    ? 1
                              : first >= 0xC2 && first < 0xE0 ? 2
                              : first >= 0xE0 && first < 0xF0 ? 3
                              : first >= 0xF0 && first < 0xF5 ? 4
                                                              : 0;
    char32_t code = bytes == 1 ? first : first & (0x7FU >> bytes);
    for (std::size_t n = 1; n < bytes; ++n) {
        if ((byte(n) & 0xC0U) != 0x80)
            return {};
        code = code << 6 | (byte(n) & 0x3FU);
    }
    // Overlong, a surrogate, or beyond the last code point.
    constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < smallest[bytes] || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF)
        return {};
    return {code, bytes};
}

bool isUtf8(const std::string &text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = codePointAt(text, at).bytes;
        if (bytes == 0)
            return false;
        at += bytes;
    }
    return true;
}

} // namespace pellucid::system
