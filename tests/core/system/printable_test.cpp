// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/printable.h"

#include <gtest/gtest.h>

namespace pellucid::system {

TEST(Printable, IsOneLineWithoutControls) {
    EXPECT_EQ(printable("a\tb\r\nc\x1b[2J\x7f"), "a b  c [2J ");
    EXPECT_EQ(printable("a\xC2\x9B"
                        "b\xE2\x80\xA8"
                        "c\xE2\x80\xA9"
                        "d"),
              "a b c d"); // C1, separators
    EXPECT_EQ(printable("M\xFCller"), "M?ller");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a b");
}

// What nobody sees makes a text look like a different one, or reverses the text after it.
TEST(Printable, HiddenCharactersVanish) {
    for (const char *hidden :
         {"\xE2\x80\xAE", "\xE2\x81\xA6", "\xD8\x9C", "\xE2\x80\x8F", "\xE2\x80\x8B",
          "\xE2\x81\xA0", "\xEF\xBB\xBF", "\xC2\xAD", "\xF3\xA0\x81\xA1"})
        EXPECT_EQ(printable(std::string("DOE") + hidden + " JANE"), "DOE JANE");
}

TEST(Printable, NamesOfAllScriptsAreUnchanged) {
    for (const char *name : {"M\xC3\xBCller^J\xC3\xB6rg", "\xE7\x8E\x8B^\xE5\xB0\x8F",
                             // Persian and Devanagari need the joiners.
                             "\xD9\x86\xDB\x8C\xE2\x80\x8C\xDA\xA9",
                             "\xE0\xA4\x95\xE0\xA5\x8D\xE2\x80\x8D\xE0\xA4\xB7",
                             // A Chinese character and the selector of its form.
                             "\xE8\x91\x9B\xF3\xA0\x84\x80", "\xF0\x9F\xA9\xBB"})
        EXPECT_EQ(printable(name), name);
}

} // namespace pellucid::system
