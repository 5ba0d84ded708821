// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/study_results.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "core/batch/derived_uid.h"
#include "core/batch/memory_shares.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::batch {

namespace {

namespace fs = std::filesystem;

DoneRecord sample() {
    DoneRecord record;
    record.program = "pellucid-cli 1";
    record.recipe = "abc";
    record.inputs = "def";
    record.studyUid = "1.2.3";
    record.seriesUid = "1.2.3.4";
    record.outputs = {{"front", 1e-3, 5e-4, 2e-4, {"a warning"}},
                      {"left", 1e-3, 5e-4, std::nullopt, {}}}; // was not measured
    record.loadSeconds = 1.5;
    return record;
}

void makeResults(const fs::path &out, const DoneRecord &record, const std::string &text) {
    StudyResults results(out, "1.2.3");
    test::writeText(results.folder() / "front.png", text);
    results.publish(record);
}

std::set<std::string> namesIn(const fs::path &folder) {
    std::set<std::string> names;
    for (const auto &entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

} // namespace

TEST(StudyResults, AppearAtOnceAndReplaceFormerOnes) {
    const test::TemporaryFolder out;
    {
        StudyResults unfinished(out.path(), "1.2.3");
        test::writeText(unfinished.folder() / "front.png", "x");
        EXPECT_FALSE(fs::exists(out / "1.2.3"));
    }
    EXPECT_EQ(namesIn(out.path()), std::set<std::string>{});
    makeResults(out.path(), sample(), "first");
    EXPECT_EQ(namesIn(out.path()), std::set<std::string>{"1.2.3"});
    EXPECT_EQ(namesIn(out / "1.2.3"), (std::set<std::string>{"done.json", "front.png"}));
    makeResults(out.path(), sample(), "second");
    EXPECT_EQ(test::readText(out / "1.2.3/front.png"), "second");
    EXPECT_EQ(namesIn(out.path()), std::set<std::string>{"1.2.3"});
    const auto done = doneIn(out / "1.2.3");
    ASSERT_TRUE(done);
    EXPECT_EQ(toJson(*done), test::readText(out / "1.2.3/done.json"));
    EXPECT_EQ(done->outputs.front().warnings, sample().outputs.front().warnings);
}

TEST(StudyResults, AreDoneOnlyIfNothingHasChanged) {
    const test::TemporaryFolder out;
    EXPECT_FALSE(isDone(out / "1.2.3", sample()));
    makeResults(out.path(), sample(), "text");
    EXPECT_TRUE(isDone(out / "1.2.3", sample()));
    for (std::string DoneRecord::*const changed :
         {&DoneRecord::program, &DoneRecord::recipe, &DoneRecord::inputs, &DoneRecord::sentTo}) {
        DoneRecord other = sample();
        other.*changed += "x";
        EXPECT_FALSE(isDone(out / "1.2.3", other));
    }
    test::writeText(out / "1.2.3/front.png", "another size");
    EXPECT_FALSE(isDone(out / "1.2.3", sample()));
    test::writeText(out / "1.2.3/done.json", "{\"program\": 5}");
    EXPECT_FALSE(isDone(out / "1.2.3", sample()));
}

TEST(DoneRecord, DigestsChangeWithTheFiles) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "a", "first");
    test::writeText(folder / "b", "second");
    const std::vector<InputFile> files{{folder / "a", folder / "a"}, {folder / "b", folder / "b"}};
    const std::string before = digestOf(files);
    EXPECT_EQ(digestOf({files[1], files[0]}), before);
    EXPECT_NE(digestOf({files[0]}), before);
    // GCC's library counts whole seconds on Windows.
    fs::last_write_time(folder / "b", fs::last_write_time(folder / "b") + std::chrono::seconds(1));
    EXPECT_NE(digestOf(files), before);
}

// Each study is in one part, and the parts are of about the same size.
TEST(DoneRecord, ShardsCoverAllStudies) {
    constexpr int count = 4, studies = 4000;
    std::array<int, count> sizes{};
    for (int n = 0; n < studies; ++n) {
        const std::string key = "1.2.826.0.1." + std::to_string(n);
        const int shard = shardOf(key, count);
        ASSERT_EQ(shard, shardOf(key, count));
        ASSERT_GE(shard, 0);
        ASSERT_LT(shard, count);
        ++sizes[std::size_t(shard)];
    }
    for (const int size : sizes)
        EXPECT_NEAR(size, studies / count, 4 * 28); // four standard deviations
    EXPECT_EQ(shardOf("1.2.3", 1), 0);
}

TEST(DerivedUid, IsAUidOfItsText) {
    std::set<std::string> all;
    for (int n = 0; n < 1000; ++n) {
        const std::string uid = derivedUid(std::to_string(n));
        EXPECT_EQ(uid, derivedUid(std::to_string(n)));
        EXPECT_LE(uid.size(), 64U);
        EXPECT_EQ(uid.rfind("2.25.", 0), 0U);
        EXPECT_NE(uid[5], '0');
        all.insert(uid);
    }
    EXPECT_EQ(all.size(), 1000U);
    // The first half of SHA-256 of nothing, with version and variant:
    // e3b0c44298fc8c149afbf4c8996fb924.
    EXPECT_EQ(derivedUid(""), "2.25.302652579918966106791432553938847512868");
}

TEST(MemoryShares, AreNeverMoreThanThereIs) {
    MemoryShares shares(100, 4);
    std::atomic<std::size_t> taken = 0;
    std::atomic<bool> isTooMuch = false;
    {
        std::vector<std::jthread> jobs;
        for (int n = 0; n < 8; ++n)
            jobs.emplace_back([&, n] {
                for (int k = 0; k < 50; ++k) {
                    // One of them needs more than there is: it gets all of it, alone.
                    const auto share = shares.take(n == 0 ? 500 : std::size_t(n) * 9, {});
                    EXPECT_GE(share.bytes(), 25U);
                    if ((taken += share.bytes()) > 100)
                        isTooMuch = true;
                    std::this_thread::yield();
                    taken -= share.bytes();
                }
            });
    }
    EXPECT_FALSE(isTooMuch);
    // While one that needs all waits, those that ask after it wait, too.
    std::stop_source atOnce;
    atOnce.request_stop();
    {
        std::jthread large;
        const auto held = shares.take(25, {});
        large = std::jthread([&] { shares.take(100, {}); });
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        bool hasToWait = false;
        while (!hasToWait && std::chrono::steady_clock::now() < end) {
            try {
                shares.take(1, task::Progress(atOnce.get_token())); // there is enough for it
            } catch (const task::Cancelled &) {
                hasToWait = true;
            }
        }
        EXPECT_TRUE(hasToWait);
    }
    std::stop_source stop;
    const auto all = shares.take(100, {});
    stop.request_stop();
    EXPECT_THROW(shares.take(1, task::Progress(stop.get_token())), task::Cancelled);
}

} // namespace pellucid::batch
