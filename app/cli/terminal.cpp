// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/terminal.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "core/system/utf8.h"

namespace pellucid::cli {

namespace {

using system::CodePoint;
using system::codePointAt;

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

std::string counted(std::size_t count, const std::string &noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void warn(const std::string &what) {
    std::fprintf(stderr, "pellucid-cli: warning: %s\n", printable(what).c_str());
}

} // namespace pellucid::cli
