// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/text.h"

#include <gtest/gtest.h>

namespace pellucid::system {

TEST(Text, LoweredChangesTheLettersOfAsciiAlone) {
    EXPECT_EQ(lowered("LPS [@] AZ az 0 \xC3\x84\xE9\xA0\xAD"),
              "lps [@] az az 0 \xC3\x84\xE9\xA0\xAD");
}

} // namespace pellucid::system
