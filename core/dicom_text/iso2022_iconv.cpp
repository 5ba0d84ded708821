// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/iso2022.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <initializer_list>

#include <iconv.h>

namespace pellucid::dicom_text {

namespace {

// The set of bytes from 0x80 up, besides ASCII.
enum class High { none, katakana, table };

struct Set {
    std::string_view number; ///< "100" of ISO_IR 100 and ISO 2022 IR 100
    char designation;        ///< after ESC -
    const char *name;        ///< name for iconv
};
constexpr std::array sets{
    Set{"100", 'A', "ISO-8859-1"},  Set{"101", 'B', "ISO-8859-2"}, Set{"109", 'C', "ISO-8859-3"},
    Set{"110", 'D', "ISO-8859-4"},  Set{"144", 'L', "ISO-8859-5"}, Set{"127", 'G', "ISO-8859-6"},
    Set{"126", 'F', "ISO-8859-7"},  Set{"138", 'H', "ISO-8859-8"}, Set{"148", 'M', "ISO-8859-9"},
    Set{"203", 'b', "ISO-8859-15"}, Set{"166", 'T', "TIS-620"}};

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

// An invalid character becomes a question mark, and reading continues. `width`: bytes per
// character.
std::string converted(std::string bytes, const char *from, std::size_t width) {
    const iconv_t converter = ::iconv_open("UTF-8", from);
    if (reinterpret_cast<std::intptr_t>(converter) == -1)
        return "?";
    std::string out(4 * bytes.size() + 8, '\0');
    char *in = bytes.data(), *to = out.data();
    std::size_t left = bytes.size(), space = out.size();
    while (::iconv(converter, &in, &left, &to, &space) == std::size_t(-1) && space > 0) {
        *to++ = '?';
        --space;
        if (errno != EILSEQ || left < width)
            break;
        in += width;
        left -= width;
    }
    ::iconv_close(converter);
    out.resize(out.size() - space);
    return out;
}

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
        if (m_designated == Designated::jis0208)
            return converted("\x1b$B" + part + "\x1b(B", "ISO-2022-JP-2", 2);
        if (m_designated == Designated::jis0212)
            return converted("\x1b$(D" + part + "\x1b(B", "ISO-2022-JP-2", 2);
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
            if (text.starts_with("\x1b-") && text.size() > 2 && text[2] == set.designation) {
                setHigh(High::table, set.name);
                return 3;
            }
        return 0;
    }

private:
    std::string readSingle(const std::string &bytes) const {
        if (m_high == High::table)
            return converted(bytes, m_table, 1);
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

// DICOM's character sets (PS3.3, C.12.1.1.2) under glibc's names. Their tables are libraries, which
// stay loaded as long as a converter is open.
constexpr std::array characterSets{
    "ISO-IR-6",      "ISO-8859-1",  "ISO-8859-2",  "ISO-8859-3", "ISO-8859-4",    "ISO-8859-5",
    "ISO-8859-6",    "ISO-8859-7",  "ISO-8859-8",  "ISO-8859-9", "ISO-8859-15",   "TIS-620",
    "JIS_X0201",     "ISO-IR-87",   "ISO-IR-159",  "ISO-IR-149", "ISO-2022-JP",   "ISO-2022-JP-1",
    "ISO-2022-JP-2", "ISO-2022-KR", "ISO-2022-CN", "EUC-KR",     "EUC-JP",        "GB18030",
    "GBK",           "GB2312",      "UTF-8",       "ASCII",      "ANSI_X3.4-1968"};

} // namespace

bool usesIso2022(const std::set<std::string> &terms) {
    const auto numbers = {"13", "87", "159", "203"};
    return std::any_of(numbers.begin(), numbers.end(),
                       [&](const char *number) { return hasTerm(terms, number); });
}

std::string utf8OfIso2022(std::string_view text, const std::set<std::string> &terms,
                          const std::string &first) {
    Reader reader(terms, first);
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

void openCharacterTables() {
    for (const char *const set : characterSets)
        (void)::iconv_open("UTF-8", set); // left open on purpose; unknown sets are not used
}

} // namespace pellucid::dicom_text
