// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/is_below.h"

#include <gtest/gtest.h>

namespace pellucid::files {

TEST(IsBelow, ComparesWholeNamesWhateverTheSlashes) {
    const std::filesystem::path folder = "/home/a/files";
    EXPECT_TRUE(isBelow("/home/a/files/x/1.dcm", folder));
    EXPECT_TRUE(isBelow(std::filesystem::path("/home/a/files/1.dcm").make_preferred(), folder));
    EXPECT_FALSE(isBelow(folder, folder));
    EXPECT_FALSE(isBelow("/home/a/files2/1.dcm", folder));
    EXPECT_FALSE(isBelow("/home/a", folder));
    // Whether letters of either case are equal depends on the system.
    EXPECT_EQ(isBelow("/home/a/FILES/1.dcm", folder), platform::isSameName("FILES", "files"));
}

} // namespace pellucid::files
