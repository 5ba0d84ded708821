// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <system_error>

#include "core/platform/folders.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::platform {

namespace {

namespace fs = std::filesystem;

TEST(Folders, OnesThatAreMadeAreTheUsersAlone) {
    const test::TemporaryFolder folder;
    makePrivateFolder(folder / "own");
    EXPECT_EQ(fs::status(folder / "own").permissions(), fs::perms::owner_all);
    EXPECT_THROW(makePrivateFolder(folder / "own"), std::system_error);
    EXPECT_THROW(makePrivateFolder(folder / "no" / "parent"), std::system_error);
}

TEST(Folders, ChangePlaces) {
    const test::TemporaryFolder folder;
    for (const char *const name : {"a", "b"}) {
        makePrivateFolder(folder / name);
        test::writeText(folder / name / "text", name);
    }
    if (!exchange(folder / "a", folder / "b"))
        GTEST_SKIP() << "this file system cannot";
    EXPECT_EQ(test::readText(folder / "a" / "text"), "b");
    EXPECT_EQ(test::readText(folder / "b" / "text"), "a");
    EXPECT_FALSE(exchange(folder / "a", folder / "missing"));
}

TEST(Folders, OfTheUserFollowTheEnvironment) {
    const test::TemporaryFolder home;
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    ::setenv("HOME", home.path().c_str(), 1);
    EXPECT_EQ(userCachePath(), home / ".cache/pellucid");
    ::setenv("XDG_CACHE_HOME", (home / "cache").c_str(), 1);
    EXPECT_EQ(userCachePath(), home / "cache/pellucid");
    EXPECT_FALSE(fs::exists(home / "cache"));
}

} // namespace
} // namespace pellucid::platform
