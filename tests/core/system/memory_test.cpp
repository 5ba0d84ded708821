// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/memory.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/little_memory.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::system {

TEST(Memory, TheLimitsOfControlGroupsCount) {
    const auto unlimited = std::numeric_limits<std::size_t>::max();
    const test::TemporaryFolder root;
    const auto write = [&](const std::string &path, const std::string &text) {
        const auto file = root / path;
        std::filesystem::create_directories(file.parent_path());
        test::writeText(file, text);
    };
    EXPECT_EQ(groupFreeBytes(root.path()), unlimited); // no such system
    write("proc/self/cgroup", "0::/user/session\n");
    EXPECT_EQ(groupFreeBytes(root.path()), unlimited);
    const std::string second = "sys/fs/cgroup/";
    write(second + "user/session/memory.max", "max\n");
    write(second + "user/session/memory.current", "300\n");
    EXPECT_EQ(groupFreeBytes(root.path()), unlimited);
    write(second + "user/memory.max", "1000\n");
    write(second + "user/memory.current", "400\n");
    EXPECT_EQ(groupFreeBytes(root.path()), 600U);
    write(second + "user/memory.stat", "anon 7\ninactive_file 150\nactive_file 8\n");
    EXPECT_EQ(groupFreeBytes(root.path()), 750U);
    write(second + "user/memory.current", "2000\n");
    EXPECT_EQ(groupFreeBytes(root.path()), 0U);

    write("proc/self/cgroup", "5:cpu:/a\n4:hugetlb,memory:/b/c\n0::/\n");
    const std::string first = "sys/fs/cgroup/memory/";
    write(first + "b/c/memory.limit_in_bytes", "9223372036854771712\n");
    write(first + "b/c/memory.usage_in_bytes", "10\n");
    write(first + "memory.limit_in_bytes", "5000\n");
    write(first + "memory.usage_in_bytes", "100\n");
    EXPECT_EQ(groupFreeBytes(root.path()), 4900U);
}

#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
TEST(Memory, TheLimitOfTheProcessCounts) {
    const std::size_t without = availableMemoryBytes();
    constexpr std::size_t mb = 1 << 20;
    {
        const test::LittleMemory little(512);
        EXPECT_LE(mappableBytes(), 512 * mb);
        EXPECT_GT(mappableBytes(), 500 * mb);
        // Libraries need a part of it.
        EXPECT_LE(availableMemoryBytes(), 400 * mb);
        EXPECT_NO_THROW(requireMemory(256.0 * mb));
        EXPECT_THROW(requireMemory(400.0 * mb), task::Error);
    }
    EXPECT_GT(availableMemoryBytes(), without / 2);
}
#endif

} // namespace pellucid::system
