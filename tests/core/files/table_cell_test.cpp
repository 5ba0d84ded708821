// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/table_cell.h"

#include <gtest/gtest.h>

namespace pellucid::files {

// A spreadsheet takes a cell that begins with one of these for a formula, also after a tab or
// blanks.
TEST(TableCell, NoTextIsAFormula) {
    EXPECT_EQ(tableCell("=HYPERLINK(\"http://x\")"), "'=HYPERLINK(\"http://x\")");
    EXPECT_EQ(tableCell("+A1"), "'+A1");
    EXPECT_EQ(tableCell("-1+cmd|' /C calc'!A0"), "'-1+cmd|' /C calc'!A0");
    EXPECT_EQ(tableCell("@SUM(1)"), "'@SUM(1)");
    EXPECT_EQ(tableCell("\t=1"), "' =1");
    EXPECT_EQ(tableCell("\r\n=1"), "'  =1");
    EXPECT_EQ(tableCell("\xE2\x80\x8B=1"), "'=1"); // after a zero-width space
    EXPECT_EQ(tableCell("\xEF\xBC\x9D"
                        "1"),
              "'\xEF\xBC\x9D"
              "1"); // a wide sign
}

TEST(TableCell, IsOneLineWithoutTabs) {
    EXPECT_EQ(tableCell("liver\tleft\r\nlobe"), "liver left  lobe");
}

TEST(TableCell, OtherTextsAreUnchanged) {
    for (const char *text :
         {"", " ", "liver", "1=2", "a-b", "M\xC3\xBCller, J\xC3\xB6rg", "'quoted'"})
        EXPECT_EQ(tableCell(text), text);
}

// An expression is not a number.
TEST(TableCell, NumbersStayNumbers) {
    for (const char *text : {"-12.5", "+1", "-1024", "-5\\7\\-31.7", "-1e-3"})
        EXPECT_EQ(tableCell(text), text);
    for (const char *text : {"-1+2", "-", "-inf", "-1\\", "-1\\=1"})
        EXPECT_EQ(tableCell(text), std::string("'") + text);
}

TEST(TableCell, AFieldOfCsvIsInQuotes) {
    EXPECT_EQ(csvField("A, \"b\""), "\"A, \"\"b\"\"\"");
    EXPECT_EQ(csvField(""), "\"\"");
}

} // namespace pellucid::files
