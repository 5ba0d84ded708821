// SPDX-License-Identifier: GPL-3.0-or-later
// Classes that combine others, and what regions marked by hand do to a look.
#include <memory>

#include <gtest/gtest.h>

#include "core/classify/region_edits.h"
#include "core/task/error.h"
#include "tests/support/json_text.h"

namespace pellucid {
namespace {

using classify::LassoCut;
using classify::Look;
using classify::RegionUse;
using classify::Step;
using classify::StepKind;
using classify::Stroke;
using classify::TissueClass;

constexpr classify::FieldWindow window{-1000.0, 2000.0};
const Stroke stroke{{{{1.0, 2.0, 3.0}}, {{1.5, -2.25, 3.0}}}, 4.5, false};
const LassoCut cut{{{{0.0, 0.0, 0.0}}, {{10.0, 0.0, 1.0}}, {{0.0, 10.0, 2.0}}},
                   {0.0, 0.0, 1.0},
                   {{-5.0, 7.0}},
                   true};

TissueClass named(const std::string &name) {
    TissueClass tissue;
    tissue.name = name;
    tissue.low = 100.0;
    tissue.high = 300.0;
    return tissue;
}

Step combining(StepKind kind, const std::string &name) {
    Step step{kind};
    step.operand.name = name;
    return step;
}

// vessels without bone, where bone includes metal
Look vessels() {
    Look look{{}, {named("vessels"), named("bone"), named("metal")}};
    look.classes[0].steps = {combining(StepKind::difference, "bone")};
    look.classes[1].steps = {combining(StepKind::join, "metal")};
    look.classes[1].low = 250.0;
    look.classes[2].low = 290.0;
    return look;
}

std::string reasonOf(const Look &look) {
    try {
        validate(look);
    } catch (const task::Error &error) {
        return error.reason().english();
    }
    return "valid";
}

std::string refusalOf(const std::string &json) {
    try {
        test::readJson<classify::Look>(json);
    } catch (const task::Error &error) {
        return error.reason().english();
    }
    return "read";
}

TEST(Operands, TakeThePlaceOfNames) {
    const Look look = vessels();
    EXPECT_EQ(reasonOf(look), "valid");
    const auto classes = withOperands(look);
    const TissueClass &bone = *classes[0].steps.front().operand.own;
    EXPECT_EQ(bone.low, 250.0);
    EXPECT_EQ(bone.steps.front().operand.own->low, 290.0);
    EXPECT_TRUE(classes[0].steps.front().operand.name.empty());
    // Weight, color and name of the other class change nothing.
    Look other = look;
    other.classes[1].weight = 0.0;
    other.classes[1].color = {0.5, 0.0, 0.0};
    EXPECT_EQ(withOperands(other)[0], classes[0]);
    other.classes[2].low = 280.0;
    EXPECT_FALSE(withOperands(other)[0] == classes[0]);
}

TEST(Operands, OfMissingClassesAndOfItselfAreRefused) {
    Look look = vessels();
    look.classes[2].steps = {combining(StepKind::intersection, "vessels")};
    EXPECT_EQ(reasonOf(look), "the steps of the class 'bone' combine it with itself");
    EXPECT_TRUE(dependsOn(look, look.classes[2], "bone"));
    look = vessels();
    EXPECT_TRUE(dependsOn(look, look.classes[0], "metal"));
    EXPECT_FALSE(dependsOn(look, look.classes[1], "vessels"));
    look.classes[0].steps.front().operand.name = "liver";
    EXPECT_EQ(
        reasonOf(look),
        "the steps of the class 'vessels' need the class 'liver', which the look does not have");
    look.classes[0].steps = {Step{StepKind::join}};
    EXPECT_EQ(reasonOf(look), "class 'vessels': the step 'or' needs another class");
    // Each of these combines the next one twice.
    Look doubling;
    for (int n = 0; n < 30; ++n) {
        doubling.classes.push_back(named(std::to_string(n)));
        if (n < 29)
            doubling.classes.back().steps.assign(2,
                                                 combining(StepKind::join, std::to_string(n + 1)));
    }
    EXPECT_EQ(reasonOf(doubling), "the steps of the class '0' combine more than 256 classes");
}

TEST(Operands, StayWhenClassesAreRenamedOrRemoved) {
    const Look look = vessels();
    Look changed = look;
    TissueClass renamed = look.classes[1];
    renamed.name = "metal"; // is taken
    replaceClass(changed, 1, renamed);
    EXPECT_EQ(changed.classes[1].name, "metal (2)");
    EXPECT_EQ(changed.classes[0].steps.front().operand.name, "metal (2)");
    EXPECT_EQ(withOperands(changed)[0], withOperands(look)[0]);
    removeClass(changed, 1);
    EXPECT_EQ(reasonOf(changed), "valid");
    EXPECT_EQ(withOperands(changed)[0], withOperands(look)[0]);
    removeClass(changed, 1); // the metal, which the removed class names
    EXPECT_EQ(reasonOf(changed), "valid");
    EXPECT_EQ(withOperands(changed)[0], withOperands(look)[0]);
    Look deep{{}, {named("0")}};
    for (int n = 1; n < 12; ++n) { // each combines the one before
        deep.classes.push_back(named(std::to_string(n)));
        deep.classes.back().steps = {combining(StepKind::join, std::to_string(n - 1))};
    }
    for (int n = 0; n < 8; ++n)
        removeClass(deep, 0);
    EXPECT_EQ(reasonOf(deep), "valid");
    removeClass(deep, 0);
    EXPECT_NE(reasonOf(deep).find("nested too deep"), std::string::npos); // as when it is read
    addClass(changed, named("vessels"));
    EXPECT_EQ(changed.classes.back().name, "vessels (2)");
}

TEST(RegionSteps, GoThroughJson) {
    Look look = vessels();
    look.classes[2].isDrawn = true;
    Stroke erasing = stroke;
    erasing.erases = true;
    Step painted{StepKind::paint}, cutting{StepKind::scissors}, connected{StepKind::connected};
    painted.strokes = {stroke, erasing};
    cutting.cuts = {cut, cut};
    cutting.cuts.back().slabMm.reset();
    cutting.cuts.back().keeps = false;
    connected.points = {{{0.1, 1e-3, -250.123456789}}};
    connected.parameters = {{"leak_mm", 2.0}};
    Step own{StepKind::intersection};
    own.operand.own = std::make_shared<const TissueClass>(
        classify::connectedRegion({{1.0, 2.0, 3.0}}, 10.0, 20.0, 0.0));
    look.classes[2].steps = {painted, cutting, connected, {StepKind::fill}, own};
    EXPECT_EQ(test::readJson<classify::Look>(test::jsonText(look)), look);
    EXPECT_EQ(
        refusalOf(R"({"classes":[{"name":"a","range":[0,1],"steps":[{"kind":"without",
              "class":"b"}]}]})"),
        "/classes: the steps of the class 'a' need the class 'b', which the look does not have");
    EXPECT_EQ(refusalOf(R"({"classes":[{"name":"a","range":[0,1],"steps":[{"kind":"paint","strokes":
              [{"path":[],"radius_mm":2}]}]}]})"),
              "/classes/0/steps/0/strokes/0: the number of points is 0, not between 1 and 10000");
    EXPECT_EQ(refusalOf(R"({"classes":[{"name":"a","range":[0,1],"steps":[{"kind":"scissors","cuts":
              [{"outline":[[0,0,0],[1,0,0],[0,1,0]],"sight":[0,0,2]}]}]}]})"),
              "/classes/0/steps/0/cuts/0: the line of sight of a cut is not a unit vector");
    EXPECT_EQ(refusalOf(R"({"classes":[{"name":"a","range":[0,1],"steps":[{"kind":"scissors","cuts":
              [{"outline":[[0,0,0],[1,0,0],[0,1,0]],"sight":[0,0,1],"keeps":true}]}]}]})"),
              "/classes/0/steps/0/cuts/0/keeps: unknown member 'keeps': use one of outline, sight, "
              "slab_mm, keep");
    Look twins{{}, {named("a"), named("b"), named("b")}};
    EXPECT_EQ(reasonOf(twins), "valid");
    twins.classes[0].steps = {combining(StepKind::join, "b")};
    EXPECT_NE(reasonOf(twins).find("several of that name"), std::string::npos);
    EXPECT_EQ(refusalOf(R"({"classes":[{"name":"a","range":[0,1],"steps":[{"kind":"fill","points":
              [[0,0,0]]}]}]})"),
              "/classes/0/steps/0: the step 'fill' has no parameters");
    std::string nested = R"({"name":"a","range":[0,1]})";
    for (int n = 0; n < 9; ++n)
        nested = R"({"name":"a","range":[0,1],"steps":[{"kind":"or","class":)" + nested + "}]}";
    EXPECT_NE(refusalOf(R"({"classes":[)" + nested + "]}").find("nested too deep"),
              std::string::npos);
}

TEST(RegionEdits, ChangeTheVolumeOrOneClass) {
    const TissueClass region = classify::connectedRegion({{1.0, 2.0, 3.0}}, 10.0, 20.0, 1.5);
    EXPECT_EQ(region.steps.front().at("leak_mm"), 1.5);
    Look look;
    EXPECT_EQ(useRegion(look, region, RegionUse::newClass, {}, window), 1U);
    ASSERT_EQ(look.classes.size(), 2U); // the volume stays to be seen
    EXPECT_EQ(look.classes[0], classify::volumeClass({}, window));
    useRegion(look, region, RegionUse::remove, {}, window);
    for (const TissueClass &tissue : look.classes) {
        EXPECT_EQ(tissue.steps.back().kind, StepKind::difference);
        EXPECT_EQ(*tissue.steps.back().operand.own, region);
        EXPECT_EQ(tissue.edge, classify::defaultEdge);
    }
    useRegion(look, region, RegionUse::keep, 0, window);
    EXPECT_EQ(look.classes[0].steps.back().kind, StepKind::intersection);
    EXPECT_EQ(look.classes[1].steps.back().kind, StepKind::difference);
    useRegion(look, region, RegionUse::add, 1, window);
    EXPECT_EQ(look.classes[1].steps.back().kind, StepKind::join);
    EXPECT_EQ(useRegion(look, region, RegionUse::newClass, {}, window), 2U);
    EXPECT_EQ(look.classes[2].name, "Region (2)");
    EXPECT_FALSE(look.classes[2].color == look.classes[1].color);
}

TEST(RegionEdits, CutsAndStrokesInARowShareAStep) {
    Look look;
    cutClasses(look, cut, {}, window);
    cutClasses(look, cut, {}, window);
    ASSERT_EQ(look.classes.size(), 1U);
    ASSERT_EQ(look.classes[0].steps.size(), 1U);
    EXPECT_EQ(look.classes[0].steps[0].cuts.size(), 2U);
    const auto drawn = paintClass(look, {stroke}, {}, window);
    EXPECT_EQ(drawn, 1U);
    EXPECT_TRUE(look.classes[1].isDrawn);
    EXPECT_EQ(paintClass(look, {stroke}, drawn, window), drawn);
    ASSERT_EQ(look.classes[1].steps.size(), 1U);
    EXPECT_EQ(look.classes[1].steps[0].strokes.size(), 2U);
    EXPECT_EQ(reasonOf(look), "valid");
}

TEST(RegionEdits, OfCutRegionsLeaveNothingInAPreset) {
    // A region that was cut out is all that it was; without its cut it would be the whole volume.
    Look look{{}, {named("bone")}};
    useRegion(look, classify::cutRegion(cut), RegionUse::newClass, {}, window);
    useRegion(look, classify::cutRegion(cut), RegionUse::add, 0, window);
    const auto drawn = paintClass(look, {stroke}, std::nullopt, window);
    addStep(look, {StepKind::grow}, *drawn);
    const Look plain = withoutMarks(look);
    ASSERT_EQ(plain.classes.size(), 1U);
    EXPECT_TRUE(plain.classes[0].steps.empty());
}

TEST(RegionEdits, PresetsKeepTheStepsAndAskForPoints) {
    Look look{{}, {named("vessels")}};
    const TissueClass region = classify::connectedRegion({{1.0, 2.0, 3.0}}, 10.0, 20.0, 1.5);
    useRegion(look, region, RegionUse::newClass, {}, window);
    useRegion(look, region, RegionUse::remove, 0, window);
    cutClasses(look, cut, 0, window);
    const auto drawn = paintClass(look, {stroke}, std::nullopt, window);
    look.classes[0].steps.push_back(combining(StepKind::difference, look.classes[*drawn].name));
    EXPECT_FALSE(awaitingClass(look));
    Look plain = withoutMarks(look);
    ASSERT_EQ(plain.classes.size(), 2U); // nothing is left of the drawn one
    ASSERT_EQ(plain.classes[0].steps.size(), 1U);
    EXPECT_EQ(reasonOf(plain), "valid");
    EXPECT_EQ(withoutMarks(plain), plain);
    EXPECT_EQ(awaitingClass(plain), 0U); // its own region waits
    EXPECT_TRUE(addPoint(plain.classes[0], {{4.0, 5.0, 6.0}}));
    EXPECT_EQ(plain.classes[0].steps[0].operand.own->steps[0].points.size(), 1U);
    EXPECT_EQ(awaitingClass(plain), 1U);
    EXPECT_TRUE(addPoint(plain.classes[1], {{4.0, 5.0, 6.0}}));
    EXPECT_FALSE(awaitingClass(plain));
    EXPECT_TRUE(addPoint(plain.classes[1], {{7.0, 5.0, 6.0}})); // one more
    EXPECT_EQ(plain.classes[1].steps[0].points.size(), 2U);
    TissueClass none = named("none");
    EXPECT_FALSE(addPoint(none, {}));
}

} // namespace
} // namespace pellucid
