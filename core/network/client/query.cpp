// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/query.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace pellucid::network {

bool isUid(const std::string &text) {
    return !text.empty() && text.size() <= 64 && text.front() != '.' && text.back() != '.' &&
           text.find("..") == std::string::npos &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

std::string percentEncoded(const std::string &text, const char *plain) {
    constexpr const char *digits = "0123456789ABCDEF";
    std::string encoded;
    for (const char c : text) {
        const auto byte = (unsigned char)(c);
        if (std::isalnum(byte) != 0 || (c != '\0' && std::strchr(plain, c) != nullptr))
            encoded += c;
        else
            encoded += {'%', digits[byte >> 4], digits[byte & 0xf]};
    }
    return encoded;
}

} // namespace pellucid::network
