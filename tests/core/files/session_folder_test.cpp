// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of unfinished files: what a killed program leaves is removed, and nothing else, whatever
// others have put beside it.
#include "core/files/session_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>
#include <vector>

#ifndef _WIN32
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "core/files/atomic_file.h"
#include "core/files/file_set.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::files {

namespace fs = std::filesystem;

namespace {

const std::string planted = ".pellucid-abcdef";

std::vector<std::string> namesIn(const fs::path &folder) {
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

// What a program leaves that is killed in the middle.
void leaveOne(const fs::path &parent) {
#ifdef _WIN32 // it has no fork
    SessionFolder folder = SessionFolder::in(parent);
    test::writeText(folder.path() / "half.png", "half");
    folder.setAbandoned(true);
#else
    const pid_t child = ::fork();
    if (child == 0) {
        const SessionFolder folder = SessionFolder::in(parent);
        test::writeText(folder.path() / "half.png", "half");
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
#endif
}

#ifndef _WIN32
std::string mark() {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    return std::string("Pellucid session folder on ") + host.data() + "\n";
}

// The user's own folder, with a lock file as other tools have them.
void makeProject(const fs::path &project) {
    fs::create_directories(project / "data");
    test::writeText(project / "data/precious", "precious");
    test::writeText(project / "data.lock", "");
    test::writeText(project / ".lock", "");
}

void expectProject(const fs::path &project) {
    EXPECT_EQ(test::readText(project / "data/precious"), "precious");
    EXPECT_TRUE(fs::exists(project / "data.lock"));
    EXPECT_TRUE(fs::exists(project / ".lock"));
}
#endif

} // namespace

TEST(SessionFolder, WhatAKilledProgramLeavesIsRemovedByTheNext) {
    const test::TemporaryFolder folder;
    leaveOne(folder.path());
    ASSERT_EQ(namesIn(folder.path()).size(), 1U);
    {
        const SessionFolder running = SessionFolder::in(folder.path());
        test::writeText(running.path() / "0.png", "new");
        removeAbandonedSessionFolders(folder.path());
        ASSERT_EQ(namesIn(folder.path()).size(), 1U); // that of a running program stays
        EXPECT_EQ(test::readText(running.path() / "0.png"), "new");
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
    fs::create_directory(folder / planted); // a program was killed before it had the lock
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

#ifndef _WIN32
TEST(SessionFolder, LinksThatOthersHavePlantedAreNotFollowed) {
    const test::TemporaryFolder folder;
    makeProject(folder / "project");
    test::writeText(folder / "project/.lock", mark());
    fs::create_directory(folder / "study");
    fs::create_directory_symlink(folder / "project", folder / "study" / planted);
    // As they were named in earlier versions.
    for (const char *const name : {".pellucid-unfinished", ".unfinished-host"})
        fs::create_directory_symlink(folder / "project", folder / "study" / name);
    {
        FileSet set(folder / "study/turn_0.png");
        test::writeText(set.aside(folder / "study/turn_0.png"), "first");
        set.commit();
    }
    expectProject(folder / "project");
    EXPECT_EQ(test::readText(folder / "study/turn_0.png"), "first");
    EXPECT_EQ(namesIn(folder / "study").size(), 4U);
}

// A folder of that name, with a link as its lock, or as a part of its contents.
TEST(SessionFolder, LinksInsideAreNotFollowed) {
    const test::TemporaryFolder folder;
    makeProject(folder / "project");
    fs::create_directory(folder / planted);
    test::writeText(folder / "mark", mark());
    fs::create_symlink(folder / "mark", folder / planted / ".lock");
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::exists(folder / planted));
    fs::remove(folder / planted / ".lock");
    test::writeText(folder / planted / ".lock", mark());
    fs::create_directory_symlink(folder / "project", folder / planted / "linked");
    removeAbandonedSessionFolders(folder.path());
    EXPECT_FALSE(fs::exists(folder / planted));
    expectProject(folder / "project");
}

TEST(SessionFolder, OnlyFoldersWithItsMarkAreRemoved) {
    const test::TemporaryFolder folder;
    for (const std::string &text : {std::string("anything"), mark() + "x",
                                    std::string("Pellucid session folder on another host\n")}) {
        fs::create_directory(folder / planted);
        test::writeText(folder / planted / ".lock", text);
        test::writeText(folder / planted / "precious", "precious");
        removeAbandonedSessionFolders(folder.path());
        EXPECT_EQ(test::readText(folder / planted / "precious"), "precious") << text;
        fs::remove_all(folder / planted);
    }
    // Others could have put anything into a folder that they may write to.
    fs::create_directory(folder / planted);
    test::writeText(folder / planted / ".lock", mark());
    ASSERT_EQ(::chmod((folder / planted).c_str(), 0777), 0);
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::exists(folder / planted));
    // A pipe as the lock does not keep the program waiting.
    fs::remove(folder / planted / ".lock");
    ASSERT_EQ(::chmod((folder / planted).c_str(), 0700), 0);
    ASSERT_EQ(::mkfifo((folder / planted / ".lock").c_str(), 0600), 0);
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::exists(folder / planted));
}

TEST(SessionFolder, FoldersOfOtherUsersStay) {
    if (::geteuid() != 0)
        GTEST_SKIP() << "only root can make files of other users";
    constexpr uid_t other = 65534;
    const test::TemporaryFolder folder;
    fs::create_directory(folder / planted);
    test::writeText(folder / planted / ".lock", mark());
    ASSERT_EQ(::chown((folder / planted).c_str(), other, other), 0);
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::exists(folder / planted / ".lock"));
    ASSERT_EQ(::chown((folder / planted).c_str(), 0, 0), 0);
    ASSERT_EQ(::chown((folder / planted / ".lock").c_str(), other, other), 0);
    removeAbandonedSessionFolders(folder.path());
    EXPECT_TRUE(fs::exists(folder / planted / ".lock"));
    ASSERT_EQ(::chown((folder / planted / ".lock").c_str(), 0, 0), 0);
    removeAbandonedSessionFolders(folder.path());
    EXPECT_FALSE(fs::exists(folder / planted));
}

// The path of a session folder is that of an open file, which tells the user nothing.
TEST(SessionFolder, ErrorsNameTheFolderOfTheOutput) {
    const test::TemporaryFolder folder;
    const SessionFolder session = SessionFolder::in(folder.path());
    const auto failure = [&](const fs::path &path) {
        try {
            AtomicFile file(path);
            ::rlimit before{};
            ::getrlimit(RLIMIT_FSIZE, &before);
            const ::rlimit none{0, before.rlim_max};
            const auto handler = std::signal(SIGXFSZ, SIG_IGN);
            ::setrlimit(RLIMIT_FSIZE, &none);
            try {
                file.write("x");
                file.commit();
            } catch (const task::Error &) {
                ::setrlimit(RLIMIT_FSIZE, &before);
                std::signal(SIGXFSZ, handler);
                throw;
            }
        } catch (const task::Error &error) {
            return error.path();
        }
        return fs::path();
    };
    const std::string named = failure(session.path() / "0.png").string();
    EXPECT_TRUE(named.starts_with(fs::canonical(folder.path()).string() + "/")) << named;
    EXPECT_TRUE(named.ends_with("/0.png")) << named;
    EXPECT_EQ(failure(folder / "1.png"), folder / "1.png");
}

// The owner of the folder around it puts a different one in its place.
TEST(SessionFolder, AFolderThatIsExchangedKeepsItsFiles) {
    const test::TemporaryFolder folder;
    makeProject(folder / "project");
    fs::create_directory(folder / "out");
    {
        FileSet set(folder / "out/turn_0.png");
        const fs::path aside = set.aside(folder / "out/turn_0.png");
        test::writeText(aside, "right");
        const std::string name = namesIn(folder / "out").at(0);
        fs::rename(folder / "out" / name, folder / "out/moved");
        fs::create_directory(folder / "out" / name);
        test::writeText(folder / "out" / name / "0.png", "wrong");
        set.commit();
        fs::remove_all(folder / "out" / name);
        fs::create_directory_symlink(folder / "project", folder / "out" / name);
    }
    EXPECT_EQ(test::readText(folder / "out/turn_0.png"), "right");
    expectProject(folder / "project");
}
#endif

} // namespace pellucid::files
