// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <limits>

#ifndef _WIN32
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "core/platform/process.h"

namespace pellucid::platform {

namespace {

TEST(Process, HasAnIdentityWhileItRuns) {
    const std::string own = processIdentity(ownProcess());
    EXPECT_FALSE(own.empty());
    EXPECT_EQ(processIdentity(ownProcess()), own);
    EXPECT_NE(processIdentity(1), own);
    EXPECT_EQ(processIdentity(std::numeric_limits<int>::max()), "");
}

TEST(Process, KnowsItsProgram) {
    EXPECT_EQ(programFile().stem(), "platform_test");
    EXPECT_TRUE(std::filesystem::exists(programFile()));
}

TEST(Process, KnowsItsMachine) {
    const Machine machine = thisMachine();
    EXPECT_FALSE(machine.system.empty());
    EXPECT_GT(machine.memoryBytes, std::size_t(1) << 26);
    EXPECT_GT(stackToUse(), std::size_t(1) << 16);
}

TEST(Process, RandomBytesDiffer) {
    std::array<std::byte, 32> a{}, b{};
    fillRandomly(a);
    fillRandomly(b);
    EXPECT_NE(a, b);
}

#ifndef _WIN32
// Otherwise a browser that it starts could not be ended, and a logout would wait for it.
TEST(Process, ProgramsThatItStartsCanBeAskedToEnd) {
    const auto statusOf = [](pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return WEXITSTATUS(status);
    };
    if (const pid_t program = ::fork(); program > 0) {
        EXPECT_EQ(statusOf(program), 0);
        return;
    }
    whenAskedToEnd([] {}, [] {});
    if (const pid_t started = ::fork(); started > 0)
        ::_exit(statusOf(started));
    sigset_t blocked;
    ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    ::_exit(::sigismember(&blocked, SIGTERM) + ::sigismember(&blocked, SIGINT));
}
#endif

} // namespace
} // namespace pellucid::platform
