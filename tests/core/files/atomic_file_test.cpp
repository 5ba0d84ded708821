// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <random>
#include <sstream>

#ifndef _WIN32
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include "core/files/atomic_file.h"
#include "core/files/image_files.h"
#include "core/files/reasons.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

std::string contents(const std::filesystem::path &path) {
    std::ostringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return out.str();
}

std::size_t entries(const std::filesystem::path &folder) {
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(AtomicFile, AppearsOnCommitAndReplacesTheOldOne) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a") << "old";
    files::AtomicFile file(folder / "a");
    file.write("new");
    EXPECT_EQ(contents(folder / "a"), "old");
    file.commit();
    EXPECT_EQ(contents(folder / "a"), "new");
    EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
    const test::TemporaryFolder folder;
    { files::AtomicFile file(folder / "a"); }
    EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(AtomicFile, ReportsAFolderThatDoesNotExist) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(files::AtomicFile(folder / "no/such/file"), task::Error);
}

#ifndef _WIN32
// Runs f with a limit of 1 kB on files. True if it failed as on a full disk.
template <class F> bool isRefusedWhenFull(F &&f) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{1024, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    bool failed = false;
    try {
        f();
    } catch (const task::Error &error) {
        failed = error.code() == task::ErrorCode::output;
    }
    setrlimit(RLIMIT_FSIZE, &before);
    return failed;
}

TEST(AtomicFile, AFullDiskKeepsTheOldFile) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a") << "old";
    EXPECT_TRUE(isRefusedWhenFull([&] {
        files::AtomicFile file(folder / "a");
        const std::vector<std::byte> much(1 << 20);
        file.write(much);
        file.commit();
    }));
    EXPECT_EQ(contents(folder / "a"), "old");
    EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(AtomicFile, AFullDiskLeavesNoPicture) {
    const test::TemporaryFolder folder;
    std::vector<std::uint8_t> noise(std::size_t(64) * 64 * 4);
    std::mt19937 random(1);
    for (std::uint8_t &value : noise)
        value = std::uint8_t(random());
    EXPECT_TRUE(isRefusedWhenFull([&] { files::writePng(folder / "a.png", noise, 64, 64); }));
    EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(AtomicFile, FollowsLinksAndLeavesWhatIsNoFile) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "target") << "old";
    std::filesystem::create_symlink(folder / "target", folder / "link");
    {
        files::AtomicFile file(folder / "link");
        const std::string text = "new";
        file.write(text);
        file.commit();
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(contents(folder / "target"), "new");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THROW(files::AtomicFile(folder / "pipe"), task::Error);
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

// In /tmp, another user could otherwise choose which file of this user is replaced.
TEST(AtomicFile, ALinkOfAnotherUserIsNotFollowedWhereAnybodyMayMakeOne) {
    namespace fs = std::filesystem;
    if (::geteuid() != 0)
        GTEST_SKIP() << "needs root to make links of another user";
    constexpr uid_t other = 65534;
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "shared");
    const fs::path planted = folder / "shared/picture.png";
    const auto write = [](const fs::path &path) {
        files::AtomicFile file(path);
        file.write("new");
        file.commit();
    };
    fs::create_symlink(folder / "mine", planted);
    fs::create_symlink(planted, folder / "to the planted one");
    const auto isRefused = [&](const fs::path &path) {
        std::ofstream(folder / "mine") << "old";
        try {
            write(path);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::output);
            EXPECT_TRUE(error.reason().is(task::because::isALinkOfAnotherUser));
            EXPECT_EQ(error.path(), planted);
        }
        EXPECT_TRUE(fs::is_symlink(planted));
        return contents(folder / "mine") == "old";
    };
    ASSERT_EQ(::chmod((folder / "shared").c_str(), 01777), 0);
    EXPECT_FALSE(isRefused(planted)); // it is this user's
    ASSERT_EQ(::lchown(planted.c_str(), other, other), 0);
    EXPECT_TRUE(isRefused(planted));
    EXPECT_TRUE(isRefused(folder / "to the planted one"));
    // Who owns the folder may do what they like with it, and nobody else makes links in a private
    // one.
    ASSERT_EQ(::chown((folder / "shared").c_str(), other, other), 0);
    EXPECT_FALSE(isRefused(planted));
    ASSERT_EQ(::chown((folder / "shared").c_str(), 0, 0), 0);
    ASSERT_EQ(::chmod((folder / "shared").c_str(), 0755), 0);
    EXPECT_FALSE(isRefused(planted));
}

// Nor as a folder on the way.
TEST(UserFolders, AFolderOfAnotherUserIsNotFollowedWhereAnybodyMayMakeOne) {
    namespace fs = std::filesystem;
    if (::geteuid() != 0)
        GTEST_SKIP() << "needs root to make links of another user";
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "shared");
    fs::create_directory(folder / "elsewhere");
    const fs::path planted = folder / "shared/study";
    fs::create_symlink(folder / "elsewhere", planted);
    ASSERT_EQ(::chmod((folder / "shared").c_str(), 01777), 0);
    files::createPrivateFolders(planted / "mine"); // the link is this user's
    constexpr uid_t other = 65534;
    ASSERT_EQ(::lchown(planted.c_str(), other, other), 0);
    EXPECT_THROW(files::createPrivateFolders(planted / "theirs"), task::Error);
    EXPECT_FALSE(fs::exists(folder / "elsewhere/theirs"));
}

TEST(AtomicFile, LinksInACircleAreNotReplaced) {
    const test::TemporaryFolder folder;
    std::filesystem::create_symlink(folder / "b", folder / "a");
    std::filesystem::create_symlink("a", folder / "b");
    EXPECT_THROW(files::AtomicFile(folder / "a"), task::Error);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a"));
}
#endif

TEST(Npy, HasAnAlignedHeaderAndTheSamples) {
    const test::TemporaryFolder folder;
    const std::vector<float> samples{1, 2, 3, 4, 5, 6};
    files::writeNpy(folder / "a.npy", samples, 2, 3);
    const std::string bytes = contents(folder / "a.npy");
    EXPECT_EQ(bytes.substr(0, 6), "\x93NUMPY");
    EXPECT_EQ((bytes.size() - 24) % 64, 0U);
    EXPECT_NE(bytes.find("'shape': (2, 3)"), std::string::npos);
    EXPECT_EQ(bytes.substr(bytes.size() - 24),
              std::string(reinterpret_cast<const char *>(samples.data()), 24));
}

} // namespace
} // namespace pellucid
