// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace pellucid::system {

/// ASCII letters in lower case; other characters are unchanged, whatever the locale.
inline std::string lowered(std::string text) {
    for (char &c : text)
        if (c >= 'A' && c <= 'Z')
            c = char(c - 'A' + 'a');
    return text;
}

/// ASCII letters in upper case; other characters are unchanged, whatever the locale.
inline std::string uppercased(std::string text) {
    for (char &c : text)
        if (c >= 'a' && c <= 'z')
            c = char(c - 'a' + 'A');
    return text;
}

/// The name itself or, if it is taken, with a number: "liver (2)". It is taken then.
inline std::string uniqueName(const std::string &name, std::set<std::string> &taken) {
    std::string result = name;
    for (int n = 2; !taken.insert(result).second; ++n)
        result = name + " (" + std::to_string(n) + ")";
    return result;
}

/// Parses a decimal number, whatever the locale: with a decimal point, and optionally an exponent;
/// or "inf" or "nan". Empty if the text has anything before or after it, including a plus sign or a
/// blank, or if double precision cannot represent it.
inline std::optional<double> numberFrom(std::string_view text) {
    double number = 0.0;
    const char *const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

/// The same, but accepts leading blanks and a plus sign, as people type them.
inline std::optional<double> typedNumberFrom(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\n\v\f\r"), text.size()));
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    return numberFrom(text);
}

} // namespace pellucid::system
