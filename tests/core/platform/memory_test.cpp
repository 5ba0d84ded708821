// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "core/platform/memory.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::platform {

#ifndef _WIN32 // which has no control groups
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
#endif

#ifndef PELLUCID_SANITIZED
TEST(Memory, LargePagesAreWholeAndComeBackEmpty) {
    std::byte *const pages = mapLargePages(3 * largePage);
    ASSERT_NE(pages, nullptr);
    EXPECT_EQ(std::uintptr_t(pages) % largePage, 0U);
    pages[0] = pages[2 * largePage] = std::byte(7);
    discardLargePages(pages + 2 * largePage, largePage);
    EXPECT_EQ(pages[0], std::byte(7));
    EXPECT_EQ(pages[2 * largePage], std::byte(0));
    unmapLargePages(pages, 3 * largePage);
}
#endif

} // namespace pellucid::platform
