// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/query.h"

#include <algorithm>

namespace pellucid::exchange {

bool isUid(const std::string &text) {
    return !text.empty() && text.size() <= 64 && text.front() != '.' && text.back() != '.' &&
           text.find("..") == std::string::npos &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

} // namespace pellucid::exchange
