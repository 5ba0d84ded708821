// SPDX-License-Identifier: GPL-3.0-or-later
// outcomes.md lists the outcome of each folder of real and nasty files: the volumes, the images,
// and the unused files with their reasons. Any other outcome is a change to review.
#include <gtest/gtest.h>

#include <set>

#include "tests/core/dicom/outcome.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace fs = std::filesystem;

TEST(Outcomes, AreThoseOfTheTable) {
    PELLUCID_NEEDS_TEST_DATA();
    auto expected = test::outcomesTable();
    std::erase_if(expected, [](const auto &row) { return row.first.starts_with("habit: "); });
    std::set<std::string> seen;
    for (const auto &entry : fs::directory_iterator(test::testData())) {
        if (!entry.is_directory())
            continue;
        const std::string name = entry.path().filename().string();
        seen.insert(name);
        EXPECT_EQ(test::outcomeOf(entry.path()), expected[name]);
    }
    EXPECT_EQ(seen.size(), expected.size());
}

} // namespace pellucid
