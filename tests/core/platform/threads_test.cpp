// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

#include "core/platform/threads.h"

namespace pellucid {

namespace {

TEST(Threads, ThePriorityOfOneIsLoweredAlone) {
    const int before = getpriority(PRIO_PROCESS, id_t(gettid()));
    int lowered = 0;
    std::jthread([&] {
        platform::lowerPriority();
        lowered = getpriority(PRIO_PROCESS, id_t(gettid()));
    }).join();
    EXPECT_EQ(lowered, 19);
    EXPECT_EQ(getpriority(PRIO_PROCESS, id_t(gettid())), before);
}

TEST(Threads, StaysOnItsProcessor) {
    const std::vector<int> all = platform::allowedProcessors();
    ASSERT_FALSE(all.empty());
    EXPECT_NE(std::find(all.begin(), all.end(), platform::currentProcessor()), all.end());
    std::jthread([&] {
        platform::stayOn(all.back());
        EXPECT_EQ(platform::currentProcessor(), all.back());
        EXPECT_EQ(platform::allowedProcessors(), std::vector{all.back()});
    }).join();
    EXPECT_EQ(platform::allowedProcessors(), all);
}

} // namespace
} // namespace pellucid
