// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/memory.h"

#include <gtest/gtest.h>

#include "core/platform/memory.h"
#include "core/task/error.h"
#include "tests/support/little_memory.h"

namespace pellucid::system {

#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
TEST(Memory, TheLimitOfTheProcessCounts) {
    const std::size_t without = availableMemoryBytes();
    constexpr std::size_t mb = 1 << 20;
    {
        const test::LittleMemory little(512);
        EXPECT_LE(platform::mappableBytes(), 512 * mb);
        EXPECT_GT(platform::mappableBytes(), 500 * mb);
        // Libraries need a part of it.
        EXPECT_LE(availableMemoryBytes(), 400 * mb);
        EXPECT_NO_THROW(requireMemory(256.0 * mb));
        EXPECT_THROW(requireMemory(400.0 * mb), task::Error);
    }
    EXPECT_GT(availableMemoryBytes(), without / 2);
}
#endif

} // namespace pellucid::system
