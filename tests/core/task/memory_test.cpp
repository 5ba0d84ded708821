// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/memory.h"

#include <gtest/gtest.h>

#include "core/task/error.h"
#include "tests/support/little_memory.h"

namespace pellucid::task {

#ifndef PELLUCID_SANITIZED // which reserve terabytes
TEST(Memory, TheLimitOfTheProcessIsAsGoodAsNoMore) {
    const std::size_t without = availableMemoryBytes();
    constexpr std::size_t mb = 1 << 20;
    {
        const test::LittleMemory little(512);
        EXPECT_LE(mappableBytes(), 512 * mb);
        EXPECT_GT(mappableBytes(), 500 * mb);
        // Not all of it: libraries want some.
        EXPECT_LE(availableMemoryBytes(), 400 * mb);
        EXPECT_NO_THROW(requireMemory(256.0 * mb));
        EXPECT_THROW(requireMemory(400.0 * mb), Error);
    }
    EXPECT_GT(availableMemoryBytes(), without / 2);
}
#endif

} // namespace pellucid::task
