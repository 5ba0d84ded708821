// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/transfer_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <numeric>
#include <sqlite3.h>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace {

Transfer sample() {
    Transfer transfer;
    transfer.server = "archive";
    transfer.wanted = {"1.2.3", {"1.2.3.4", "1.2.3.5"}};
    transfer.title = "2026-01-15 Chest";
    transfer.folder = "/tmp/somewhere";
    return transfer;
}

} // namespace

TEST(TransferLog, RemembersTransfersAndArrivals) {
    const test::TemporaryFolder folder;
    std::int64_t id = 0;
    {
        TransferLog log(folder / "transfers.sqlite");
        id = log.add(sample());
        EXPECT_EQ(log.add(sample()), id); // the same once more
        EXPECT_TRUE(log.claim(id));
        log.update(id, {.wanted = 512, .present = 12, .received = 100, .bytes = 52428800}, 3.5);
        log.addArrival({"/x/1.dcm", "1.2.3", "1.2.3.4", "1.2.3.4.5", "1.2.840", 99}, "SENDER");
    }
    TransferLog log(folder / "transfers.sqlite");
    const Transfer transfer = log.transfer(id).value();
    EXPECT_EQ(transfer.server, "archive");
    EXPECT_EQ(transfer.wanted.seriesUids, sample().wanted.seriesUids);
    EXPECT_EQ(transfer.state, TransferState::running);
    EXPECT_EQ(transfer.total, 512U);
    EXPECT_EQ(transfer.received, 112U);
    ASSERT_EQ(log.arrivals().size(), 1U);
    EXPECT_EQ(log.arrivals().front().sopInstanceUid, "1.2.3.4.5");
    log.removeArrivals(log.arrivals());
    EXPECT_TRUE(log.arrivals().empty());
    EXPECT_FALSE(log.hasClaim(id)); // that was the former program's
    EXPECT_TRUE(log.claim(id));
    EXPECT_TRUE(log.hasClaim(id));
    log.finish(id, TransferState::complete, {}, 4.0, {});
    log.clearFinished();
    EXPECT_TRUE(log.transfers().empty());
}

// Cancelled and tried again while the first attempt still ends: its end changes nothing.
TEST(TransferLog, AnAttemptThatIsOverDoesNotEndTheNext) {
    const test::TemporaryFolder folder;
    TransferLog first(folder / "transfers.sqlite"), second(folder / "transfers.sqlite");
    const std::int64_t id = first.add(sample());
    ASSERT_TRUE(first.claim(id));
    second.cancel(id);
    EXPECT_FALSE(first.hasClaim(id));
    second.retry(id);
    ASSERT_TRUE(second.claim(id));
    EXPECT_FALSE(first.hasClaim(id));
    first.finish(id, TransferState::cancelled, {}, 1.0, {});
    EXPECT_TRUE(second.hasClaim(id));
    second.finish(id, TransferState::complete, {}, 1.0, {});
    EXPECT_EQ(first.transfer(id)->state, TransferState::complete);
}

// An attempt that took a transfer over removes it itself.
TEST(TransferLog, OnlyTheLastAttemptRemovesATransfer) {
    const test::TemporaryFolder folder;
    TransferLog first(folder / "transfers.sqlite"), second(folder / "transfers.sqlite");
    const std::int64_t id = first.add(sample());
    ASSERT_TRUE(first.claim(id));
    second.retry(id);
    ASSERT_TRUE(second.claim(id));
    first.remove(id);
    EXPECT_TRUE(second.hasClaim(id));
    second.remove(id);
    EXPECT_FALSE(first.transfer(id).has_value());
}

#ifndef _WIN32
// A transfer belongs to one program, until that has ended.
TEST(TransferLog, AKilledProgramReleasesItsTransfer) {
    const test::TemporaryFolder folder;
    std::int64_t id = 0;
    {
        TransferLog log(folder / "transfers.sqlite");
        id = log.add(sample());
    }
    std::array<int, 2> ready{};
    ASSERT_EQ(::pipe(ready.data()), 0);
    const pid_t other = ::fork();
    if (other == 0) {
        TransferLog log(folder / "transfers.sqlite");
        const char hasIt = log.claim(id) ? 'y' : 'n';
        (void)!::write(ready[1], &hasIt, 1);
        ::pause();
        ::_exit(0);
    }
    char hasIt = 0;
    ASSERT_EQ(::read(ready[0], &hasIt, 1), 1);
    EXPECT_EQ(hasIt, 'y');
    TransferLog log(folder / "transfers.sqlite");
    EXPECT_FALSE(log.claim(id));
    EXPECT_EQ(log.transfer(id)->state, TransferState::running);
    ::kill(other, SIGKILL);
    ::waitpid(other, nullptr, 0);
    EXPECT_EQ(log.transfers().front().state, TransferState::waiting);
    EXPECT_TRUE(log.claim(id));
}
#endif

// A second run into the same place finds all there; what the first one brought is still told.
TEST(TransferLog, BytesAndTimeAddUpOverTheRuns) {
    const test::TemporaryFolder folder;
    TransferLog log(folder / "transfers.sqlite");
    const std::int64_t id = log.add(sample());
    ASSERT_TRUE(log.claim(id));
    log.finish(id, TransferState::incomplete, {.wanted = 3, .received = 2, .bytes = 2000}, 4.0, {});
    log.add(sample());
    ASSERT_TRUE(log.claim(id));
    log.update(id, {.wanted = 3, .present = 2, .bytes = 500}, 0.5);
    log.finish(id, TransferState::complete,
               {.wanted = 3, .present = 2, .received = 1, .bytes = 1000}, 1.0, {});
    log.add(sample());
    ASSERT_TRUE(log.claim(id));
    log.finish(id, TransferState::complete, {.wanted = 3, .present = 3}, 0.3, {});
    const Transfer transfer = log.transfer(id).value();
    EXPECT_EQ(transfer.received, 3U);
    EXPECT_EQ(transfer.bytes, 3000U);
    EXPECT_EQ(transfer.seconds, 5.0);
}

TEST(TransferLog, WhatSomebodyWaitsForIsNotPutOff) {
    const test::TemporaryFolder folder;
    TransferLog log(folder / "transfers.sqlite");
    Transfer inAdvance = sample();
    inAdvance.isForLater = true;
    const std::int64_t id = log.add(inAdvance);
    EXPECT_TRUE(TransferLog(folder / "transfers.sqlite").transfer(id)->isForLater);
    log.add(sample());
    EXPECT_FALSE(log.transfer(id)->isForLater);
    log.add(inAdvance);
    EXPECT_FALSE(log.transfer(id)->isForLater);
    ASSERT_TRUE(log.claim(id));
    log.finish(id, TransferState::complete, {}, 1.0, {});
    log.add(inAdvance); // nobody waits any more
    EXPECT_TRUE(log.transfer(id)->isForLater);
    log.retry(id);
    EXPECT_FALSE(log.transfer(id)->isForLater);
}

TEST(TransferLog, ADamagedFileIsReported) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "transfers.sqlite", std::string(5000, 'x'));
    EXPECT_THROW(TransferLog(folder / "transfers.sqlite"), task::Error);
}

// Every index once; the ends first; after an eighth of them, none is farther than eight from one
// that is there.
TEST(InstanceList, ComesFromCoarseToFine) {
    for (const std::size_t n : {1U, 2U, 3U, 7U, 8U, 9U, 64U, 100U, 512U, 1000U}) {
        const auto order = coarseToFine(n);
        ASSERT_EQ(order.size(), n);
        auto sorted = order;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::size_t> all(n);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(sorted, all);
        EXPECT_EQ(order.front(), 0U);
        if (n > 1) {
            EXPECT_EQ(order[1], n - 1);
        }
        if (n < 64)
            continue;
        std::vector<std::size_t> early(order.begin(), order.begin() + std::ptrdiff_t(n / 8 + 2));
        std::sort(early.begin(), early.end());
        for (std::size_t k = 1; k < early.size(); ++k)
            EXPECT_LE(early[k] - early[k - 1], 8U) << n;
    }
}

} // namespace pellucid::archive
