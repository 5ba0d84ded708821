// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/japanese_text.h"

#include <array>
#include <iconv.h>

namespace pellucid::parse {

namespace {

// What letters of two bytes are of, until the next designation.
enum class Designated { single, jis0208, jis0212 };

struct Escape {
    std::string_view bytes;
    Designated designated;
};
constexpr std::array escapes{
    Escape{"\x1b(B", Designated::single}, Escape{"\x1b(J", Designated::single},
    Escape{"\x1b$B", Designated::jis0208}, Escape{"\x1b$@", Designated::jis0208},
    Escape{"\x1b$(D", Designated::jis0212},
    // Katakana of one byte, beside what is designated already.
    Escape{"\x1b)I", Designated::single}};

std::string converted(std::string bytes) {
    const iconv_t converter = ::iconv_open("UTF-8", "ISO-2022-JP-2");
    if (converter == iconv_t(-1))
        return "?";
    std::string out(4 * bytes.size() + 8, '\0');
    char *in = bytes.data(), *to = out.data();
    std::size_t left = bytes.size(), room = out.size();
    const bool isWhole = ::iconv(converter, &in, &left, &to, &room) != std::size_t(-1);
    ::iconv_close(converter);
    out.resize(out.size() - room);
    return isWhole ? out : out + "?";
}

// Katakana of half width (JIS X 0201) lie in one row, here and in Unicode from U+FF61.
std::string katakanaOrSame(unsigned char byte) {
    if (byte < 0x80)
        return {char(byte)};
    if (byte < 0xA1 || byte > 0xDF)
        return "?";
    const unsigned code = 0xFF61U + byte - 0xA1U;
    return {char(0xE0 | code >> 12), char(0x80 | (code >> 6 & 0x3F)), char(0x80 | (code & 0x3F))};
}

} // namespace

std::string utf8OfJapanese(std::string_view text) {
    std::string out;
    auto designated = Designated::single;
    while (!text.empty()) {
        bool isEscape = false;
        for (const Escape &escape : escapes)
            if (text.starts_with(escape.bytes)) {
                designated = escape.designated;
                text.remove_prefix(escape.bytes.size());
                isEscape = true;
                break;
            }
        if (isEscape)
            continue;
        // Up to the next designation: a byte of two may look like a delimiter.
        const std::string part(text.substr(0, text.find('\x1b', 1)));
        text.remove_prefix(part.size());
        if (designated == Designated::jis0208)
            out += converted("\x1b$B" + part + "\x1b(B");
        else if (designated == Designated::jis0212)
            out += converted("\x1b$(D" + part + "\x1b(B");
        else
            for (const char c : part)
                out += katakanaOrSame((unsigned char)(c));
    }
    return out;
}

} // namespace pellucid::parse
