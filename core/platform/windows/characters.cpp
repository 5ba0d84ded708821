// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/characters.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

constexpr UINT japanese = 20932, gbk = 936, gb18030 = 54936;

// In the order of `characterSets`; those of Korea and China have the characters of EUC-KR and
// GB2312, and more.
constexpr std::array codePages{28591U, 28592U, 28593U, 28594U,   28595U, 28596U, 28597U, 28598U,
                               28599U, 28605U, 874U,   japanese, 949U,   936U,   936U,   gb18030};
static_assert(codePages.size() == characterSets.size());

UINT pageOf(const std::string &set) {
    const auto *const found = std::find(characterSets.begin(), characterSets.end(), set);
    return codePages[std::size_t(found - characterSets.begin())];
}

// How many bytes the character at the start of a text has by its first bytes.
std::size_t lengthAt(std::string_view text, UINT page) {
    const auto byte = [&](std::size_t n) {
        return n < text.size() ? unsigned(static_cast<unsigned char>(text[n])) : 0U;
    };
    if (byte(0) < 0x80)
        return 1;
    if (page == japanese)
        return byte(0) == 0x8F ? 3 : 2;
    if (page == gb18030 && byte(1) >= '0' && byte(1) <= '9')
        return 4;
    return page == gb18030 || page == gbk || page == 949 ? 2 : 1;
}

// Empty if it is no character.
std::string converted(std::string character, UINT page) {
    if (character.size() == 1 && (character[0] & 0x80) == 0)
        return character;
    if (page == gb18030 && character.size() == 2)
        page = gbk; // of which it is an extension
    // This code page has JIS X 0212 in two bytes, the second of them without its highest bit.
    if (page == japanese && character.size() == 3)
        character = {character[1], char(character[2] & 0x7F)};
    std::array<wchar_t, 4> wide{};
    const int count = ::MultiByteToWideChar(page, MB_ERR_INVALID_CHARS, character.data(),
                                            int(character.size()), wide.data(), int(wide.size()));
    // What has no character, some code pages map to private ones.
    if (count <= 0 || (wide[0] >= 0xE000 && wide[0] <= 0xF8FF))
        return {};
    std::array<char, 16> utf8{};
    const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, wide.data(), count, utf8.data(),
                                            int(utf8.size()), nullptr, nullptr);
    return {utf8.data(), std::size_t(bytes)};
}

} // namespace

std::string utf8Of(const std::string &bytes, const std::string &characterSet) {
    const UINT page = pageOf(characterSet);
    std::string out;
    for (std::string_view rest = bytes; !rest.empty();) {
        const std::size_t length = lengthAt(rest, page);
        const std::string character =
            length <= rest.size() ? converted(std::string(rest.substr(0, length)), page) : "";
        out += character.empty() ? "?" : character;
        rest.remove_prefix(character.empty() ? 1 : length);
    }
    return out;
}

void openCharacterTables() {
    for (const UINT page : codePages) {
        CPINFO about{};
        ::GetCPInfo(page, &about);
    }
}

} // namespace pellucid::platform
