// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/iso2022.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "core/platform/characters.h"

namespace pellucid::dicom_text {

namespace {

// The set of bytes from 0x80 up, besides ASCII.
enum class High { none, katakana, table };

struct Set {
    std::string_view number;      ///< "100" of ISO_IR 100 and ISO 2022 IR 100
    std::string_view designation; ///< the escape sequence
    const char *name;             ///< of platform::characterSets
};
constexpr std::array sets{Set{"100", "\x1b-A", "ISO-8859-1"}, Set{"101", "\x1b-B", "ISO-8859-2"},
                          Set{"109", "\x1b-C", "ISO-8859-3"}, Set{"110", "\x1b-D", "ISO-8859-4"},
                          Set{"144", "\x1b-L", "ISO-8859-5"}, Set{"127", "\x1b-G", "ISO-8859-6"},
                          Set{"126", "\x1b-F", "ISO-8859-7"}, Set{"138", "\x1b-H", "ISO-8859-8"},
                          Set{"148", "\x1b-M", "ISO-8859-9"}, Set{"203", "\x1b-b", "ISO-8859-15"},
                          Set{"166", "\x1b-T", "TIS-620"},    Set{"149", "\x1b$)C", "EUC-KR"},
                          Set{"58", "\x1b$)A", "GB2312"}};
// Sets of two-byte characters that no escape sequence leaves, and what needs no conversion.
constexpr std::array wholeSets{std::pair("GB18030", "GB18030"), std::pair("GBK", "GBK"),
                               std::pair("ISO_IR 192", ""), std::pair("ISO_IR 6", ""),
                               std::pair("ISO 2022 IR 6", "")};
// Japanese sets, of which the first has half of a byte.
constexpr std::array otherNumbers{"13", "87", "159"};

// The set of two-byte characters, until the next designation.
enum class Designated { single, jis0208, jis0212 };

struct Escape {
    std::string_view bytes;
    Designated designated;
};
constexpr std::array escapes{
    Escape{"\x1b(B", Designated::single}, Escape{"\x1b(J", Designated::single},
    Escape{"\x1b$B", Designated::jis0208}, Escape{"\x1b$@", Designated::jis0208},
    Escape{"\x1b$(D", Designated::jis0212}};

// Half-width katakana (JIS X 0201) are contiguous, here and in Unicode from U+FF61.
std::string katakana(unsigned char byte) {
    if (byte < 0xA1 || byte > 0xDF)
        return "?";
    const unsigned code = 0xFF61U + byte - 0xA1U;
    return {char(0xE0 | code >> 12), char(0x80 | (code >> 6 & 0x3F)), char(0x80 | (code & 0x3F))};
}

bool hasTerm(const std::set<std::string> &terms, std::string_view number) {
    return terms.contains("ISO_IR " + std::string(number)) ||
           terms.contains("ISO 2022 IR " + std::string(number));
}

// The sets designated so far in a text.
class Reader {
public:
    Reader(const std::set<std::string> &terms, const std::string &first) {
        for (const Set &set : sets)
            if (hasTerm({first}, set.number))
                setHigh(High::table, set.name);
        // Some writers omit the designation of katakana.
        if (m_high == High::none && hasTerm(terms, "13"))
            setHigh(High::katakana, nullptr);
        m_initial = m_high;
        m_initialTable = m_table;
    }

    // Reads up to the next designation: the second byte of a character may look like a delimiter.
    std::string read(const std::string &part) {
        if (m_designated != Designated::single)
            return readPairs(part);
        std::string out;
        for (std::size_t at = 0; at < part.size();) {
            if (part[at] == '^' ||
                part[at] == '=') // designations end with each component of a name
                setHigh(m_initial, m_initialTable);
            const std::size_t end = std::min(part.find_first_of("^=", at + 1), part.size());
            out += readSingle(part.substr(at, end - at));
            at = end;
        }
        return out;
    }

    // The length of the designation at the start of a text; 0: none.
    std::size_t designate(std::string_view text) {
        for (const Escape &escape : escapes)
            if (text.starts_with(escape.bytes)) {
                m_designated = escape.designated;
                return escape.bytes.size();
            }
        if (text.starts_with("\x1b)I")) {
            setHigh(High::katakana, nullptr);
            return 3;
        }
        for (const Set &set : sets)
            if (text.starts_with(set.designation)) {
                setHigh(High::table, set.name);
                return set.designation.size();
            }
        return 0;
    }

private:
    // As EUC-JP has them: with the highest bits set, and those of JIS X 0212 after a byte more.
    std::string readPairs(const std::string &part) const {
        std::string out;
        for (std::size_t at = 0; at + 1 < part.size(); at += 2) {
            std::string pair{char(part[at] | 0x80), char(part[at + 1] | 0x80)};
            if (m_designated == Designated::jis0212)
                pair.insert(0, 1, char(0x8F));
            const std::string character = platform::utf8Of(pair, "EUC-JP");
            out += character.starts_with('?') ? "?" : character;
        }
        return part.size() % 2 == 0 ? out : out + '?';
    }
    std::string readSingle(const std::string &bytes) const {
        if (m_high == High::table)
            return platform::utf8Of(bytes, m_table);
        std::string out;
        for (const char c : bytes) {
            const auto byte = (unsigned char)(c);
            if (byte < 0x80)
                out += c;
            else
                out += m_high == High::katakana ? katakana(byte) : "?";
        }
        return out;
    }
    void setHigh(High high, const char *table) {
        m_high = high;
        m_table = table;
    }

    Designated m_designated = Designated::single;
    High m_high = High::none, m_initial = High::none;
    const char *m_table = nullptr, *m_initialTable = nullptr;
};

} // namespace

bool areKnown(const std::vector<std::string> &terms) {
    return std::all_of(terms.begin(), terms.end(), [](const std::string &term) {
        const auto isTerm = [&](std::string_view number) { return hasTerm({term}, number); };
        return term.empty() || std::any_of(otherNumbers.begin(), otherNumbers.end(), isTerm) ||
               std::any_of(sets.begin(), sets.end(),
                           [&](const Set &set) { return isTerm(set.number); }) ||
               std::any_of(wholeSets.begin(), wholeSets.end(),
                           [&](const auto &set) { return term == set.first; });
    });
}

std::string utf8OfSets(std::string_view text, const std::vector<std::string> &terms) {
    const std::string first = terms.empty() ? "" : terms.front();
    for (const auto &[term, name] : wholeSets)
        if (first == term && (terms.size() == 1 || !first.ends_with(" 6"))) // which others extend
            return *name == '\0' ? std::string(text) : platform::utf8Of(std::string(text), name);
    Reader reader({terms.begin(), terms.end()}, first);
    std::string out;
    while (!text.empty()) {
        if (const std::size_t length = reader.designate(text); length > 0) {
            text.remove_prefix(length);
            continue;
        }
        const std::string part(text.substr(0, text.find('\x1b', 1)));
        text.remove_prefix(part.size());
        out += reader.read(part);
    }
    return out;
}

} // namespace pellucid::dicom_text
