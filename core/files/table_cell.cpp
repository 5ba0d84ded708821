// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/table_cell.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/system/printable.h"
#include "core/system/text.h"

namespace pellucid::files {

namespace {

// Spreadsheets also take the wide forms of Chinese and Japanese text.
constexpr std::array<std::string_view, 8> formulaSigns{
    "=", "+", "-", "@", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"};

// Letters, such as those of "-inf", would be a name in a formula.
bool isNumbers(std::string_view text) {
    if (text.find_first_not_of("+-.0123456789eE\\ ") != std::string_view::npos)
        return false;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\\', at), text.size());
        if (!system::typedNumberFrom(text.substr(at, end - at)))
            return false;
        at = end + 1;
    }
    return true;
}

} // namespace

std::string tableCell(const std::string &text) {
    std::string cell = system::printable(text);
    if (isNumbers(cell))
        return cell;
    // Blanks before the sign may be removed on the way.
    const std::size_t first = cell.find_first_not_of(' ');
    for (const std::string_view sign : formulaSigns)
        if (first != std::string::npos && std::string_view(cell).substr(first).starts_with(sign))
            return "'" + cell;
    return cell;
}

std::string csvField(const std::string &cell) {
    std::string field = "\"";
    for (const char c : cell) {
        if (c == '"')
            field += '"';
        field += c;
    }
    return field + "\"";
}

std::string tabbedField(const std::string &cell) {
    return cell.find('"') == std::string::npos ? cell : csvField(cell);
}

} // namespace pellucid::files
