// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/couch.h"

#include <gtest/gtest.h>

namespace pellucid {
namespace {

using classify::Look;
using classify::Step;
using classify::StepKind;
using classify::TissueClass;

constexpr classify::FieldWindow window{-900.0, 2000.0};

TissueClass bone(std::vector<Step> steps) {
    return {"Bone", 200.0, 3000.0, 50.0, 1.0, {}, {}, std::move(steps), {}, 0.0};
}

TissueClass liver() {
    TissueClass tissue{"Liver", classify::lowestValue, classify::highestValue};
    tissue.segment = "liver";
    return tissue;
}

TEST(Couch, ALookWithoutClassesBecomesThePatientAndBack) {
    Look look;
    look.transferFunction.weights = {0.0, 0.5, 2.0};
    const Look before = look;
    EXPECT_FALSE(classify::isWithoutCouch(look));
    removeCouch(look, window);
    ASSERT_EQ(look.classes.size(), 1U);
    EXPECT_EQ(look.classes[0].transferFunction, before.transferFunction);
    EXPECT_EQ(look.classes[0].low, window.low);
    EXPECT_TRUE(classify::isWithoutCouch(look));
    restoreCouch(look, window);
    EXPECT_EQ(look, before);
}

TEST(Couch, IsRemovedBeforeOtherRegionsAndAfterValues) {
    Look look;
    look.classes = {bone({{StepKind::gaussian, {}}, {StepKind::largestComponent, {}}}), liver()};
    const Look before = look;
    removeCouch(look, window);
    ASSERT_EQ(look.classes[0].steps.size(), 3U);
    EXPECT_EQ(look.classes[0].steps[1].kind, StepKind::body);
    EXPECT_EQ(look.classes[1], liver()); // a segment stays what it is
    EXPECT_TRUE(classify::isWithoutCouch(look));
    restoreCouch(look, window);
    EXPECT_EQ(look, before);
}

TEST(Couch, SegmentsAloneHaveNone) {
    Look look;
    look.classes = {liver()};
    look.classes[0].steps = {{StepKind::body, {}}}; // the user's own
    const Look before = look;
    EXPECT_FALSE(classify::isWithoutCouch(look));
    removeCouch(look, window);
    restoreCouch(look, window);
    EXPECT_EQ(look, before);
}

} // namespace
} // namespace pellucid
