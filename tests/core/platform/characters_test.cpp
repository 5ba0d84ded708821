// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/characters.h"

#include <gtest/gtest.h>

namespace pellucid::platform {
namespace {

// One letter of each, and what is none.
TEST(Characters, OfEverySetBecomeUtf8) {
    openCharacterTables();
    EXPECT_EQ(utf8Of("\xE9\x41", "ISO-8859-1"), "\u00E9A");
    EXPECT_EQ(utf8Of("\xB3", "ISO-8859-2"), "\u0142");
    EXPECT_EQ(utf8Of("\xA1\xA5", "ISO-8859-3"), "\u0126?");
    EXPECT_EQ(utf8Of("\xE0", "ISO-8859-4"), "\u0101");
    EXPECT_EQ(utf8Of("\xBB", "ISO-8859-5"), "\u041B");
    EXPECT_EQ(utf8Of("\xE2", "ISO-8859-6"), "\u0642");
    EXPECT_EQ(utf8Of("\xC4\xFF", "ISO-8859-7"), "\u0394?");
    EXPECT_EQ(utf8Of("\xF9", "ISO-8859-8"), "\u05E9");
    EXPECT_EQ(utf8Of("\xF0", "ISO-8859-9"), "\u011F");
    EXPECT_EQ(utf8Of("\xA4", "ISO-8859-15"), "\u20AC");
    EXPECT_EQ(utf8Of("\xB9", "TIS-620"), "\u0E19");
    EXPECT_EQ(utf8Of("\xBB\xB3\x41\x8F\xB0\xA1", "EUC-JP"), "\u5C71A\u4E02");
    EXPECT_EQ(utf8Of("\xFB\xF3", "EUC-KR"), "\u6D2A");
    EXPECT_EQ(utf8Of("\xD0\xA1", "GB2312"), "\u5C0F");
    EXPECT_EQ(utf8Of("\xD0\xA1\x81\x40", "GBK"), "\u5C0F\u4E02");
#ifndef _WIN32 // Wine's table has no letters of four bytes
    EXPECT_EQ(utf8Of("\xD0\xA1\x81\x30\x81\x30", "GB18030"), "\u5C0F\u0080");
#endif
    EXPECT_EQ(utf8Of("a\xD0", "GB18030"), "a?"); // half of one
}

} // namespace
} // namespace pellucid::platform
