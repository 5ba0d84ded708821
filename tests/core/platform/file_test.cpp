// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <string>
#include <system_error>

#ifndef _WIN32
#include <sys/stat.h>
#endif

#include "core/platform/file.h"
#include "core/platform/folders.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::platform {

namespace {

std::string textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char *>(bytes.data()), bytes.size()};
}

TEST(File, IsReadFromAnyPlace) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "file", "abcdefgh");
    const Handle file = openForReading(folder / "file");
    std::array<std::byte, 5> bytes{};
    EXPECT_EQ(readAt(file, 6, bytes), 2U);
    EXPECT_EQ(textOf(std::span(bytes).first(2)), "gh");
    EXPECT_EQ(readSome(file, bytes), 5U); // the position has not moved
    EXPECT_EQ(textOf(bytes), "abcde");
    EXPECT_EQ(readSome(file, bytes), 3U);
    EXPECT_EQ(readSome(file, bytes), 0U);
    EXPECT_THROW(writeAll(file, bytes), std::system_error); // opened for reading
}

TEST(File, FactsTellWhenItChanges) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "file", "abc");
    const Handle file = openForReading(folder / "file");
    const FileFacts facts = factsOf(file);
    EXPECT_TRUE(facts.isRegular);
    EXPECT_EQ(facts.bytes, 3U);
    EXPECT_EQ(factsOf(file), facts);
    test::writeText(folder / "file", "abcd");
    EXPECT_NE(factsOf(file), facts);
}

#ifndef _WIN32
TEST(File, APipeDoesNotBlock) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(factsOf(openForReading(folder / "pipe")).isRegular);
}
#endif

TEST(File, IsTheSameByEveryPath) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "file", "abc");
    test::writeText(folder / "other", "abc");
    std::filesystem::create_hard_link(folder / "file", folder / "hard");
    const auto id = fileIdOf(folder / "file");
    ASSERT_TRUE(id);
    EXPECT_EQ(fileIdOf(folder / "hard"), id);
#ifndef _WIN32
    std::filesystem::create_symlink("file", folder / "soft");
    EXPECT_EQ(fileIdOf(folder / "soft"), id);
#endif
    EXPECT_NE(fileIdOf(folder / "other"), id);
    EXPECT_FALSE(fileIdOf(folder / "missing"));
    try {
        openForReading(folder / "missing");
        FAIL();
    } catch (const std::system_error &error) {
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    }
}

// Also below paths of more than 260 characters, where Windows needs to be told.
TEST(File, FoldersAreListed) {
    const test::TemporaryFolder folder;
    std::filesystem::path deep = folder / "deep";
    makePrivateFolder(deep);
    for (int n = 0; n < 10; ++n) {
        deep /= std::string(30, char('a' + n));
        makePrivateFolder(deep);
    }
    writeAll(openOrCreate(deep / "file"), std::as_bytes(std::span("abc", 3)));
    makePrivateFolder(deep / "folder");
    std::map<std::string, Entry::Kind> found;
    const auto take = [&](const Entry &entry) {
        EXPECT_FALSE(entry.isLink);
        EXPECT_EQ(entry.path.parent_path(), deep);
        found[entry.path.filename().string()] = entry.kind;
    };
    EXPECT_FALSE(listFolder(deep, take));
    EXPECT_EQ(found, (std::map<std::string, Entry::Kind>{{"file", Entry::Kind::file},
                                                         {"folder", Entry::Kind::folder}}));
    EXPECT_EQ(factsOf(openForReading(deep / "file")).bytes, 3U);
    EXPECT_EQ(listFolder(deep / "missing", take), std::errc::no_such_file_or_directory);
}

TEST(File, IsLockedByOneHandleAtATime) {
    const test::TemporaryFolder folder;
    const Handle second = openOrCreate(folder / "lock");
    {
        const Handle first = openOrCreate(folder / "lock");
        EXPECT_TRUE(lock(first, Lock::attempt));
        EXPECT_FALSE(lock(second, Lock::attempt));
    }
    EXPECT_TRUE(lock(second, Lock::wait));
    EXPECT_FALSE(openOrCreate(folder / "no" / "folder"));
}

TEST(File, IsSharedByItsMappings) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "file", "abcdefgh");
    const Handle file = openOrCreate(folder / "file");
    const auto written = map(file, 8, Access::write), read = map(file, 8, Access::read);
    written[0] = std::byte('x');
    EXPECT_EQ(textOf(read), "xbcdefgh");
    unmap(written);
    unmap(read);
    EXPECT_THROW(map({}, 8, Access::read), std::system_error);
}

} // namespace
} // namespace pellucid::platform
