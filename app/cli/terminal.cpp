// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/terminal.h"

#include <cstdio>

#include <fmt/format.h>

namespace pellucid::cli {

std::string printable(std::string text) {
    for (std::size_t n = 0; n < text.size(); ++n) {
        const auto byte = (unsigned char)(text[n]);
        const auto next = n + 1 < text.size() ? (unsigned char)(text[n + 1]) : 0U;
        if (byte < 0x20 || byte == 0x7F)
            text[n] = ' ';
        else if (byte == 0xC2 && next >= 0x80 && next < 0xA0) // UTF-8 of the C1 set
            text[n] = text[n + 1] = ' ';
    }
    return text;
}

std::string escapedControls(const std::string &json) {
    std::string escaped;
    for (std::size_t n = 0; n < json.size(); ++n) {
        const auto byte = (unsigned char)(json[n]);
        const auto next = n + 1 < json.size() ? (unsigned char)(json[n + 1]) : 0U;
        if (byte == 0x7F) {
            escaped += "\\u007f";
        } else if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {
            escaped += fmt::format("\\u{:04x}", next);
            ++n;
        } else {
            escaped += json[n];
        }
    }
    return escaped;
}

void warn(const std::string &what) {
    std::fprintf(stderr, "pellucid-cli: warning: %s\n", printable(what).c_str());
}

} // namespace pellucid::cli
