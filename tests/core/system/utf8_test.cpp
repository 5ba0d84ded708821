// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/utf8.h"

#include <gtest/gtest.h>

namespace pellucid::system {

// RFC 3629: the shortest form of a code point that is no surrogate.
TEST(Utf8, OnlyItsShortestFormIsAccepted) {
    for (const char *good : {"", "plain", "M\xC3\xBCller", "\xE7\x8E\x8B", "\xF0\x9F\xA9\xBB"})
        EXPECT_TRUE(isUtf8(good)) << good;
    for (const char *bad : {"M\xFCller", "\xC3", "\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                            "\xF4\x90\x80\x80", "\xFF", "ends in \xE7\x8E"})
        EXPECT_FALSE(isUtf8(bad)) << bad;
    EXPECT_EQ(codePointAt("M\xC3\xBCller", 1).code, 0xFCU);
    EXPECT_EQ(codePointAt("M\xC3\xBCller", 1).bytes, 2U);
}

} // namespace pellucid::system
