// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace pellucid::system {

/// A character of UTF-8.
struct CodePoint {
    char32_t code = 0;
    std::size_t bytes = 0; ///< 0: not UTF-8
};

/// *Requires*: at < text.size().
CodePoint codePointAt(const std::string &text, std::size_t at);

bool isUtf8(const std::string &text);

} // namespace pellucid::system
