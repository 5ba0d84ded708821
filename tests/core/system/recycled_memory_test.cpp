// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "core/system/recycled_memory.h"

namespace pellucid {

namespace {

using Floats = std::vector<float, system::RecycledAllocator<float>>;
constexpr std::size_t large = 1 << 20, small = 1 << 10;

#ifndef PELLUCID_SANITIZED // sanitized builds recycle nothing
TEST(RecycledMemory, LargeArraysOfOneSizeAreTakenAgain) {
    const float *dropped = nullptr;
    {
        Floats first(large);
        first.back() = 7.0F;
        dropped = first.data();
    }
    const Floats second(large);
    EXPECT_EQ(second.data(), dropped);
    EXPECT_EQ(second.back(), 7.0F); // and not set to zero
    const Floats third(large), other(large + 1);
    EXPECT_NE(third.data(), second.data());
    EXPECT_NE(other.data(), second.data());
}
#endif

TEST(RecycledMemory, ValuesThatAreGivenAreSet) {
    { const Floats dropped(large, 3.0F); }
    const Floats zeros(large, 0.0F), few(small, 2.0F);
    EXPECT_EQ(zeros, Floats(large, 0.0F));
    EXPECT_EQ(few.back(), 2.0F);
}

TEST(RecycledMemory, ThreadsNeverShareAnArray) {
    std::vector<std::thread> threads;
    std::vector<int> spoiled(4, 0);
    for (std::size_t n = 0; n < spoiled.size(); ++n)
        threads.emplace_back([&spoiled, n] {
            for (int round = 0; round < 200; ++round) {
                Floats mine(large / 8);
                mine.front() = mine.back() = float(n);
                std::this_thread::yield();
                spoiled[n] += mine.front() != float(n) || mine.back() != float(n) ? 1 : 0;
            }
        });
    for (std::thread &thread : threads)
        thread.join();
    EXPECT_EQ(spoiled, std::vector<int>(4, 0));
}

TEST(RecycledMemory, AnImpossibleSizeIsBadAlloc) {
#ifndef PELLUCID_SANITIZED // sanitized allocators end the program when asked for that much
    EXPECT_THROW(system::takeRecycled(std::size_t(1) << 62), std::bad_alloc);
#endif
}

} // namespace

} // namespace pellucid
