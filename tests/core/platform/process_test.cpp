// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <limits>

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

} // namespace
} // namespace pellucid::platform
