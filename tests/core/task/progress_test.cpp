// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <vector>

#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid {

namespace {

TEST(Progress, PartsMapToTheWholeScale) {
    std::vector<double> seen;
    const task::Progress progress({}, [&](double f) { seen.push_back(f); });
    progress.part(0.5, 1.0).part(0.0, 0.5).report(1.0);
    progress.report(2.0);
    EXPECT_EQ(seen, (std::vector<double>{0.75, 1.0}));
}

TEST(Progress, StopsWhenAsked) {
    std::stop_source source;
    const task::Progress progress(source.get_token());
    EXPECT_NO_THROW(progress.part(0, 1).report(0.1));
    source.request_stop();
    EXPECT_THROW(progress.part(0, 1).report(0.2), task::Cancelled);
    EXPECT_THROW(progress.check(), task::Cancelled);
}

TEST(Error, NamesThePath) {
    const task::Error error(task::ErrorCode::unusable, task::because::isEmpty, "/a/b");
    EXPECT_STREQ(error.what(), "/a/b: is empty");
    EXPECT_EQ(error.reason(), task::because::isEmpty);
}

} // namespace
} // namespace pellucid
