// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/text.h"

#include <clocale>
#include <cmath>
#include <locale>
#include <string>

#include <gtest/gtest.h>

namespace pellucid::system {
namespace {

// Sets a decimal comma, as in German or French: for streams on every machine, for the C library
// where such a locale is installed.
class DecimalComma {
public:
    DecimalComma()
        : m_streams(std::locale::global(std::locale(std::locale::classic(), new Comma))),
          m_library(std::setlocale(LC_NUMERIC, nullptr)) {
        for (const char *name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8", "fr_FR.utf8"})
            if (std::setlocale(LC_NUMERIC, name) != nullptr)
                return;
    }
    ~DecimalComma() {
        std::locale::global(m_streams);
        std::setlocale(LC_NUMERIC, m_library.c_str());
    }

private:
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
    };
    std::locale m_streams;
    std::string m_library;
};

TEST(Text, LoweredChangesTheLettersOfAsciiAlone) {
    EXPECT_EQ(lowered("LPS [@] AZ az 0 \xC3\x84\xE9\xA0\xAD"),
              "lps [@] az az 0 \xC3\x84\xE9\xA0\xAD");
}

TEST(Text, ANumberIsTheWholeText) {
    EXPECT_EQ(numberFrom("0"), 0.0);
    EXPECT_EQ(numberFrom("-1.5e3"), -1500.0);
    EXPECT_EQ(numberFrom(".5"), 0.5);
    EXPECT_EQ(numberFrom(std::string_view("2.5,3").substr(0, 3)), 2.5);
    // The nearest double, to the last bit.
    EXPECT_EQ(numberFrom("0.1"), 0.1);
    EXPECT_EQ(numberFrom("1.7976931348623157e308"), 1.7976931348623157e308);
    for (const char *text :
         {"", " ", "x", "-", "1x", "1 ", " 1", "+1", "1,5", "0x10", "1e", "1e999"})
        EXPECT_FALSE(numberFrom(text)) << "'" << text << "'";
}

TEST(Text, CallersDecideWhatInfinityAndNanMean) {
    EXPECT_EQ(numberFrom("inf"), HUGE_VAL);
    EXPECT_EQ(numberFrom("-inf"), -HUGE_VAL);
    ASSERT_TRUE(numberFrom("nan"));
    EXPECT_TRUE(std::isnan(*numberFrom("nan")));
}

TEST(Text, ANumberHasAPointInEveryLanguage) {
    const DecimalComma comma;
    EXPECT_EQ(numberFrom("1.5"), 1.5);
    EXPECT_EQ(typedNumberFrom("1.5"), 1.5);
    EXPECT_FALSE(numberFrom("1,5"));
    EXPECT_FALSE(typedNumberFrom("1,5"));
}

TEST(Text, ATypedNumberMayHaveBlanksBeforeItAndAPlusSign) {
    EXPECT_EQ(typedNumberFrom(" 1"), 1.0);
    EXPECT_EQ(typedNumberFrom("\t-1"), -1.0);
    EXPECT_EQ(typedNumberFrom(" +.5"), 0.5);
    for (const char *text : {"", " ", "+", "+-1", "++1", "+ 1", "1 ", "1x"})
        EXPECT_FALSE(typedNumberFrom(text)) << "'" << text << "'";
}

} // namespace
} // namespace pellucid::system
