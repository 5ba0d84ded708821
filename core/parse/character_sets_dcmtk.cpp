// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/character_sets.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <initializer_list>
#include <set>
#include <sstream>
#include <string_view>

#include <iconv.h>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcchrstr.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/dcmdata/dctk.h>

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

// What is no letter becomes a question mark, and the next ones are read. `width`: bytes of a
// letter.
std::string converted(std::string bytes, const char *from, std::size_t width) {
    const iconv_t converter = ::iconv_open("UTF-8", from);
    if (converter == iconv_t(-1))
        return "?";
    std::string out(4 * bytes.size() + 8, '\0');
    char *in = bytes.data(), *to = out.data();
    std::size_t left = bytes.size(), room = out.size();
    while (::iconv(converter, &in, &left, &to, &room) == std::size_t(-1) && room > 0) {
        *to++ = '?';
        --room;
        if (errno != EILSEQ || left < width)
            break;
        in += width;
        left -= width;
    }
    ::iconv_close(converter);
    out.resize(out.size() - room);
    return out;
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

// ISO 2022 IR 6, 13, 14, 87 and 159 (PS3.5, annex H).
std::string utf8OfJapanese(std::string_view text) {
    constexpr const char *iso2022 = "ISO-2022-JP-2";
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
            out += converted("\x1b$B" + part + "\x1b(B", iso2022, 2);
        else if (designated == Designated::jis0212)
            out += converted("\x1b$(D" + part + "\x1b(B", iso2022, 2);
        else
            for (const char c : part)
                out += katakanaOrSame((unsigned char)(c));
    }
    return out;
}

// The values of SpecificCharacterSet.
std::set<std::string> termsOf(const std::string &sets) {
    std::set<std::string> terms;
    std::istringstream each(sets);
    for (std::string term; std::getline(each, term, '\\');) {
        const auto first = term.find_first_not_of(' '), last = term.find_last_not_of(' ');
        if (first != std::string::npos)
            terms.insert(term.substr(first, last - first + 1));
    }
    return terms;
}

} // namespace

CharacterSets::CharacterSets(DcmItem &dataset) {
    OFString sets;
    if (dataset.findAndGetOFStringArray(DCM_SpecificCharacterSet, sets).bad() || sets.empty())
        return;
    const auto terms = termsOf({sets.data(), sets.size()});
    const auto has = [&](std::initializer_list<const char *> names) {
        return std::any_of(names.begin(), names.end(),
                           [&](const char *name) { return terms.contains(name); });
    };
    if (has({"ISO_IR 13", "ISO 2022 IR 13", "ISO 2022 IR 87", "ISO 2022 IR 159"})) {
        m_way = Way::japanese;
    } else if (has({"ISO_IR 203", "ISO 2022 IR 203"})) {
        m_way = Way::latin9;
    } else {
        m_dcmtk = std::make_unique<DcmSpecificCharacterSet>();
        if (m_dcmtk->selectCharacterSet(sets).good())
            m_way = Way::dcmtk;
    }
}

CharacterSets::~CharacterSets() = default;

std::string CharacterSets::utf8(const std::string &text, bool isName) const {
    switch (m_way) {
    case Way::japanese:
        return utf8OfJapanese(text);
    case Way::latin9:
        return converted(text, "ISO-8859-15", 1);
    case Way::dcmtk: {
        OFString to;
        if (m_dcmtk->convertString(text.c_str(), text.size(), to, isName ? "\\^=" : "\\").good())
            return {to.data(), to.size()};
        break;
    }
    case Way::none:
        break;
    }
    return text;
}

} // namespace pellucid::parse
