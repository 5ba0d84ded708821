// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/terminal.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace pellucid::cli {

namespace {

struct CodePoint {
    char32_t code = 0;
    std::size_t bytes = 0; ///< 0: not UTF-8
};

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

// Control characters, line separators and changes of direction.
bool controlsTerminal(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029 || c == 0x061C ||
           (c >= 0x200E && c <= 0x200F) || (c >= 0x202A && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

} // namespace

std::string printable(const std::string &text) {
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = codePointAt(text, at);
        if (point.bytes == 0)
            shown += '?';
        else if (controlsTerminal(point.code))
            shown += ' ';
        else
            shown.append(text, at, point.bytes);
        at += std::max<std::size_t>(1, point.bytes);
    }
    return shown;
}

std::string escapedControls(const std::string &json) {
    std::string escaped;
    for (std::size_t at = 0; at < json.size();) {
        const CodePoint point = codePointAt(json, at);
        const std::size_t bytes = std::max<std::size_t>(1, point.bytes);
        if (point.code >= 0x7F && controlsTerminal(point.code))
            escaped += fmt::format("\\u{:04x}", unsigned(point.code));
        else
            escaped.append(json, at, bytes);
        at += bytes;
    }
    return escaped;
}

void warn(const std::string &what) {
    std::fprintf(stderr, "pellucid-cli: warning: %s\n", printable(what).c_str());
}

} // namespace pellucid::cli
