// SPDX-License-Identifier: GPL-3.0-or-later
// A system that cannot confine the processes that read files: what somebody looks at goes on with a
// warning, and what runs unattended only if it is told to.
#include "tests/cli/faults.h"
#include "tests/support/files.h"

namespace pellucid {

using namespace test;

namespace {

const std::string unprotected = "PELLUCID_DECODER='" PELLUCID_UNPROTECTED_DECODER "' ";
const std::string says = "this system cannot confine the processes that read files";

std::size_t countOf(const std::string &word, const std::string &text) {
    std::size_t count = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++count;
    return count;
}

} // namespace

TEST_F(Faults, AMissingProtectionIsReportedOnce) {
    const fs::path in = series("head", 8);
    const auto without = cli("info " + quoted(in), unprotected), with = cli("info " + quoted(in));
    EXPECT_EQ(without.exitCode, 0) << without.error;
    EXPECT_EQ(without.out, with.out);
    EXPECT_EQ(countOf(says, without.error), 1U) << without.error;
    EXPECT_EQ(countOf(says, with.error), 0U) << with.error;
}

TEST_F(Faults, WithoutProtectionNothingRunsUnattended) {
    const fs::path in = series("head", 8), out = folder / "out";
    writeText(folder / "recipe.json",
              R"({"recipe": 1, "outputs": [{"view": "front", "size": 32}]})");
    const std::string batch =
        "batch " + quoted(folder / "recipe.json") + " " + quoted(in) + " --out " + quoted(out);
    const auto refused = cli(batch, unprotected);
    EXPECT_EQ(refused.exitCode, 2) << refused.error;
    EXPECT_EQ(countOf(says, refused.error), 1U) << refused.error;
    EXPECT_EQ(countOf("\n", refused.error), 1U) << refused.error;
    EXPECT_FALSE(fs::exists(out));
    const auto listening = cli("listen --any --port 0 --to " + quoted(out), unprotected);
    EXPECT_EQ(listening.exitCode, 2) << listening.error;
    EXPECT_EQ(countOf(says, listening.error), 1U) << listening.error;
    EXPECT_FALSE(fs::exists(out));
    const auto told = cli(batch + " --allow-unprotected", unprotected);
    EXPECT_EQ(told.exitCode, 0) << told.error;
    EXPECT_EQ(countOf(says, told.error), 1U) << told.error;
    EXPECT_TRUE(fs::exists(out));
    const auto usual = cli(batch);
    EXPECT_EQ(usual.exitCode, 0) << usual.error;
    EXPECT_EQ(usual.error.find(says), std::string::npos);
}

} // namespace pellucid
