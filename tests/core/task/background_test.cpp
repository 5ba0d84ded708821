// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/task/background.h"

namespace pellucid {

namespace {

// A thread of the pool has the priority of others.
TEST(Background, ParallelWorkStaysOnTheThread) {
    const std::thread::id here = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0, all = 0;
    int most = 0;
    task::onThisThread([&] {
        most = tbb::this_task_arena::max_concurrency();
        tbb::parallel_for(0, 5000, [&](int) {
            ++all;
            if (std::this_thread::get_id() != here)
                ++elsewhere;
        });
    });
    EXPECT_EQ(all, 5000);
    EXPECT_EQ(most, 1);
    EXPECT_EQ(elsewhere, 0);
}

} // namespace
} // namespace pellucid
