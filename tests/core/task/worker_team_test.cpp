// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "core/task/worker_team.h"
#include "tests/support/little_memory.h"

namespace pellucid {

namespace {

using task::WorkerTeam;

struct Tally {
    std::vector<std::atomic<int>> first, second;
    std::atomic<int> early{0};
    Tally() : first(97), second(31) {}
};

TEST(WorkerTeam, RunsEveryPartOnceAndPhasesInOrder) {
    for (const int threads : {1, 2, 5}) {
        WorkerTeam team(threads);
        EXPECT_EQ(team.threads(), threads);
        for (int round = 0; round < 200; ++round) {
            Tally tally;
            const std::array<WorkerTeam::Phase, 3> phases{
                {{97, [](void *c, int part, int) { ++static_cast<Tally *>(c)->first[part]; },
                  &tally},
                 {0, nullptr, nullptr},
                 {31,
                  [](void *c, int part, int) {
                      auto &t = *static_cast<Tally *>(c);
                      ++t.second[part];
                      for (const auto &count : t.first)
                          t.early += count == 1 ? 0 : 1;
                  },
                  &tally}}};
            team.run(phases);
            for (const auto &count : tally.second)
                ASSERT_EQ(count, 1);
            ASSERT_EQ(tally.early, 0);
        }
    }
}

#ifndef PELLUCID_SANITIZED
// A stack takes megabytes of address space: the team starts the workers that fit, and they do all
// the work.
TEST(WorkerTeam, FewThreadsDoAllTheWork) {
    std::unique_ptr<WorkerTeam> team;
    {
        const test::LittleMemory little(40);
        team = std::make_unique<WorkerTeam>(64);
    }
    EXPECT_LT(team->slots(), 30);
    Tally tally;
    const WorkerTeam::Phase phase{
        97, [](void *c, int part, int) { ++static_cast<Tally *>(c)->first[part]; }, &tally};
    team->run({&phase, 1});
    for (const auto &count : tally.first)
        EXPECT_EQ(count, 1);
}
#endif

TEST(WorkerTeam, NoTwoRunningPartsShareASlot) {
    WorkerTeam team(4);
    struct Slots {
        std::vector<std::atomic<int>> busy;
        std::atomic<int> shared{0};
    } slots{std::vector<std::atomic<int>>(std::size_t(team.slots())), {}};
    const WorkerTeam::Phase phase{2000,
                                  [](void *c, int, int slot) {
                                      auto &s = *static_cast<Slots *>(c);
                                      s.shared += s.busy[slot]++;
                                      --s.busy[slot];
                                  },
                                  &slots};
    team.run({&phase, 1});
    EXPECT_EQ(slots.shared, 0);
}

} // namespace
} // namespace pellucid
