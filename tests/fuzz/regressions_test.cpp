// SPDX-License-Identifier: GPL-3.0-or-later
// Every build runs the inputs that once broke a target, and the corpora, also cut short or with
// changed bytes. This finds the simplest faults without a fuzzer.
#include <algorithm>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/targets.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::fuzz {

namespace {

namespace fs = std::filesystem;

class Regressions : public testing::TestWithParam<NamedTarget> {};

} // namespace

TEST_P(Regressions, areTakenOrRefused) {
    const NamedTarget &target = GetParam();
    const fs::path found = fs::path(PELLUCID_SOURCE) / "tests/fuzz/regressions" / target.name;
    if (fs::exists(found))
        for (const auto &entry : fs::directory_iterator(found)) {
            SCOPED_TRACE(entry.path());
            target.run(test::readBytes(entry.path()));
        }
    const test::TemporaryFolder folder;
    writeCorpus(target.name, folder.path());
    ASSERT_FALSE(fs::is_empty(folder.path()));
    std::mt19937 random(11);
    for (const auto &entry : fs::directory_iterator(folder.path())) {
        const auto seed = test::readBytes(entry.path());
        target.run(seed);
        for (int round = 0; round < 60; ++round) {
            auto bytes = seed;
            if (round % 3 == 0)
                bytes.resize(random() % (bytes.size() + 1));
            for (unsigned n = 0; n < 1 + random() % 4 && !bytes.empty(); ++n)
                bytes[random() % std::min<std::size_t>(bytes.size(), 4096)] = std::byte(random());
            target.run(bytes);
        }
    }
}

// A folder that is not named after a target would never be read.
TEST(RegressionFolders, areNamedAfterTargets) {
    std::size_t folders = 0;
    for (const auto &entry :
         fs::directory_iterator(fs::path(PELLUCID_SOURCE) / "tests/fuzz/regressions")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::any_of(targets().begin(), targets().end(), [&](const NamedTarget &target) {
            return target.name == name;
        })) << name;
        ++folders;
    }
    EXPECT_GT(folders, 0U);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Regressions, testing::ValuesIn(targets()),
                         [](const auto &target) { return std::string(target.param.name); });

} // namespace pellucid::fuzz
