// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_set.h"

#include <gtest/gtest.h>

#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::files {

namespace fs = std::filesystem;

TEST(FileSet, NamesAreGivenWhenAllFilesAreThere) {
    const test::TemporaryFolder folder;
    const fs::path one = folder / "turn_0.png", two = folder / "turn_1.png";
    test::writeText(one, "of before");
    {
        FileSet set(one);
        EXPECT_EQ(set.aside(one).extension(), ".png");
        // The set is abandoned.
    }
    EXPECT_EQ(test::readText(one), "of before");
    {
        FileSet set(one);
        test::writeText(set.aside(one), "first");
        test::writeText(set.aside(two), "second");
        EXPECT_EQ(test::readText(one), "of before");
        EXPECT_FALSE(fs::exists(two));
        set.commit();
    }
    EXPECT_EQ(test::readText(one), "first");
    EXPECT_EQ(test::readText(two), "second");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2); // no other file is left
}

TEST(FileSet, AFolderThatIsNotThereIsNotMade) {
    const test::TemporaryFolder folder;
    try {
        FileSet set(folder / "slip/turn_0.png");
        ADD_FAILURE();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::output);
    }
    EXPECT_FALSE(fs::exists(folder / "slip"));
}

} // namespace pellucid::files
