// SPDX-License-Identifier: GPL-3.0-or-later
// The engine follows the scene: each row of the table is one decision.
#include "core/prepare/next_step.h"

#include <array>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/classify/layers.h"
#include "tests/core/prepare/looks.h"

namespace pellucid::prepare {

using namespace test;

// For the messages of gtest.
void PrintTo(Step step, std::ostream *out) {
    constexpr std::array names{"nothing",     "hold",      "awaitScan",       "awaitRest",
                               "stopJob",     "dropLight", "showFull",        "showLayers",
                               "startLayers", "startFull", "startCoarseFirst"};
    *out << names.at(std::size_t(step));
}

namespace {

TEST(NextStep, LooksAreRelatedAsTheTableTakesThemToBe) {
    EXPECT_TRUE(madeFor(plain).hasSameLayersAs(madeFor(weighted)));
    EXPECT_FALSE(madeFor(plain).showsSameAs(madeFor(weighted)));
    EXPECT_FALSE(madeFor(plain).hasSameLayersAs(madeFor(classes)));
    for (const Look look : {lit, cued, litCued}) {
        EXPECT_TRUE(madeFor(plain).showsSameAs(madeFor(look)));
        EXPECT_FALSE(madeFor(plain).hasSameLayersAs(madeFor(look)));
    }
    EXPECT_TRUE(madeFor(lit).hasSameLayersAs(madeFor(litWeighted)));
}

TEST(NextStep, OfManyClassesOneIsHeld) {
    PreparedFor full;
    for (int n = 0; n < 104; ++n)
        full.look.classes.push_back({"part " + std::to_string(n), 10.0 * n, 10.0 * n + 50.0});
    PreparedFor dragged = full;
    dragged.look.classes[40].weight = 0.3;
    EXPECT_TRUE(dragged.hasSameLayersAs(full));
    EXPECT_EQ(classify::onlyDifference(full.look, dragged.look), std::size_t(40));
    PreparedFor layers = dragged;
    layers.adjustedClass = 40;
    dragged.look.classes[40].weight = 0.1;
    dragged.look.classes[40].color = {0.2, 0.3, 0.4};
    EXPECT_TRUE(layers.hasSameLayersAs(dragged));
    EXPECT_TRUE(dragged.hasSameLayersAs(layers));
    // Another class, a second one, or its range: others are needed.
    PreparedFor other = full;
    other.look.classes[41].weight = 0.3;
    EXPECT_FALSE(layers.hasSameLayersAs(other));
    dragged.look.classes[2].weight = 0.5;
    EXPECT_FALSE(dragged.hasSameLayersAs(full));
    EXPECT_FALSE(layers.hasSameLayersAs(dragged));
    PreparedFor ranged = full;
    ranged.look.classes[40].high += 1.0;
    EXPECT_FALSE(layers.hasSameLayersAs(ranged));
    EXPECT_FALSE(full.hasSameLayersAs(ranged));
}

struct Row {
    const char *name;
    Occasion occasion;
    Look wanted;
    Have have;
    Step step;
};

// The name of the test in the list of ctest.
void PrintTo(const Row &row, std::ostream *out) {
    *out << row.name;
}

class NextStepTable : public testing::TestWithParam<Row> {};

TEST_P(NextStepTable, Row) {
    const Row &row = GetParam();
    EXPECT_EQ(next({madeFor(row.wanted), row.occasion}, row.have), row.step);
}

using enum Occasion;
using enum EngineStage;

const PreparedFor ofPlain = madeFor(plain), ofWeighted = madeFor(weighted),
                  ofClasses = madeFor(classes), ofLit = madeFor(lit);

const Row table[] = {
    // The scene changes: nothing to do.
    {"WhatIsThereAndShownIsHeld",
     sceneChanged,
     plain,
     {.full = ofPlain, .shown = full},
     Step::hold},
    {"WhatSettledIsHeld", sceneChanged, plain, {.full = ofPlain, .shown = settled}, Step::hold},
    {"WhatIsOnItsWayIsAwaited",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = full, .underway = engineOf(classes)},
     Step::nothing},
    {"WhatWasGivenUpStaysSo",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = full, .givenUp = ofClasses},
     Step::nothing},
    {"OfAFirstLookThatWasGivenUpNothingComes",
     sceneChanged,
     plain,
     {.givenUp = ofPlain},
     Step::nothing},
    {"AHandThatMovesLetsTheFirstPictureCome",
     sceneChanged,
     litWeighted,
     {.full = ofPlain, .shown = full, .underway = coarseFirstOf(lit)},
     Step::nothing},
    // While the studies are scanned.
    {"HeldItWaitsForTheScan",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = full, .isHeld = true},
     Step::awaitScan},
    {"HeldWhatIsThereNeedsNothing",
     sceneChanged,
     plain,
     {.full = ofPlain, .shown = full, .isHeld = true},
     Step::nothing},
    {"HeldAFirstEngineIsNotMade", sceneChanged, plain, {.isHeld = true}, Step::nothing},
    // Back to what is there.
    {"BackItStopsTheOther",
     sceneChanged,
     plain,
     {.full = ofPlain, .shown = coarse, .underway = engineOf(classes)},
     Step::stopJob},
    {"BackItIsShownInPlaceOfTheCoarseOne",
     sceneChanged,
     plain,
     {.full = ofPlain, .shown = coarse},
     Step::showFull},
    {"BackItIsShownInPlaceOfLayersThatGoOn",
     sceneChanged,
     plain,
     {.full = ofPlain, .shown = live, .underway = layersOf(weighted)},
     Step::showFull},
    // A new look.
    {"TheFirstEngineComesCoarseFirst", sceneChanged, plain, {}, Step::startCoarseFirst},
    {"AnotherLookComesCoarseFirst",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = full},
     Step::startCoarseFirst},
    {"AnotherLookStopsTheOneUnderway",
     sceneChanged,
     classes,
     {.underway = coarseFirstOf(plain)},
     Step::stopJob},
    {"AnotherLookStopsLayers",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = live, .underway = layersOf(weighted)},
     Step::stopJob},
    {"WhatWasGivenUpBeforeThisDoesNotMatter",
     sceneChanged,
     classes,
     {.full = ofPlain, .shown = full, .givenUp = ofWeighted},
     Step::startCoarseFirst},
    // Cue and light.
    {"ACueIsSeenAtOnceAndPreparedInFull",
     sceneChanged,
     cued,
     {.full = ofPlain, .shown = full},
     Step::startFull},
    {"ACueIsNotSeenWithLayers",
     sceneChanged,
     cued,
     {.full = ofPlain, .shown = live},
     Step::showFull},
    {"ACueIsNotSeenWithACoarseOne",
     sceneChanged,
     cued,
     {.full = ofPlain, .shown = coarse, .underway = engineOf(lit)},
     Step::showFull},
    {"ACueStopsTheOther",
     sceneChanged,
     cued,
     {.full = ofPlain, .shown = full, .underway = engineOf(lit)},
     Step::stopJob},
    {"ALightComesCoarseFirst",
     sceneChanged,
     lit,
     {.full = ofPlain, .shown = full},
     Step::startCoarseFirst},
    {"ALightKeepsTheCoarsePicture",
     sceneChanged,
     litCued,
     {.full = ofPlain, .shown = coarse, .underway = engineOf(lit)},
     Step::stopJob},
    {"ACueUnderLightIsPreparedInFull",
     sceneChanged,
     litCued,
     {.full = ofLit, .shown = full},
     Step::startFull},
    {"WithoutLightWhatIsThereServes",
     sceneChanged,
     plain,
     {.full = ofLit, .shown = full},
     Step::dropLight},
    {"WithoutLightTheOtherIsStopped",
     sceneChanged,
     plain,
     {.full = ofLit, .shown = full, .underway = engineOf(litCued)},
     Step::stopJob},
    {"WithoutLightButWithACueItIsDroppedFirst",
     sceneChanged,
     cued,
     {.full = ofLit, .shown = full},
     Step::dropLight},
    // Weights.
    {"WeightsThatMoveNeedLayers",
     sceneChanged,
     weighted,
     {.full = ofPlain, .shown = full},
     Step::startLayers},
    {"WeightsStopAnEngineOfAFormerSum",
     sceneChanged,
     weighted,
     {.full = ofPlain, .shown = full, .underway = engineOf(cued)},
     Step::stopJob},
    {"WeightsStopLayersOfAnotherLook",
     sceneChanged,
     weighted,
     {.full = ofPlain, .shown = full, .underway = layersOf(classes)},
     Step::stopJob},
    {"WeightsAreShownWithTheLayersThatAreThere",
     sceneChanged,
     weighted,
     {.full = ofPlain, .layers = ofPlain, .shown = full},
     Step::showLayers},
    {"WeightsAreShownWithCoarseLayersToo",
     sceneChanged,
     weighted,
     {.full = ofPlain, .layers = ofPlain, .shown = live, .underway = layersOf(plain)},
     Step::showLayers},
    {"LayersOfAnotherLookDoNotServe",
     sceneChanged,
     weighted,
     {.full = ofPlain, .layers = ofClasses, .shown = full},
     Step::startLayers},
    {"LayersUnderwayAreAwaited",
     sceneChanged,
     weighted,
     {.full = ofPlain, .shown = full, .underway = layersOf(weighted)},
     Step::awaitRest},
    {"LayersThatWereGivenUpStaySo",
     sceneChanged,
     weighted,
     {.full = ofPlain, .shown = full, .layersGivenUp = ofPlain},
     Step::awaitRest},
    {"WeightsUnderLightComeCoarseFirst",
     sceneChanged,
     litWeighted,
     {.full = ofLit, .shown = full},
     Step::startCoarseFirst},
    {"WeightsUnderLightStopTheOther",
     sceneChanged,
     litWeighted,
     {.full = ofLit, .shown = live, .underway = engineOf(litCued)},
     Step::stopJob},
    // The hand rests.
    {"AtRestTheSumIsMadeInFull",
     handRested,
     weighted,
     {.full = ofPlain, .layers = ofPlain, .shown = live},
     Step::startFull},
    {"AtRestLayersComeFirst",
     handRested,
     weighted,
     {.full = ofPlain, .shown = full, .underway = layersOf(weighted)},
     Step::awaitRest},
    {"AtRestAnotherIsStopped",
     handRested,
     weighted,
     {.full = ofPlain, .shown = live, .underway = engineOf(cued)},
     Step::stopJob},
    {"AtRestWhatIsThereNeedsNothing",
     handRested,
     plain,
     {.full = ofPlain, .shown = full},
     Step::nothing},
    {"AtRestWhatIsOnItsWayIsAwaited",
     handRested,
     weighted,
     {.full = ofPlain, .shown = live, .underway = engineOf(weighted)},
     Step::nothing},
    {"AtRestWhatWasGivenUpStaysSo",
     handRested,
     weighted,
     {.full = ofPlain, .shown = full, .givenUp = ofWeighted},
     Step::nothing},
    {"AtRestAScanIsAwaited",
     handRested,
     weighted,
     {.full = ofPlain, .shown = live, .isHeld = true},
     Step::nothing},
    // A job has delivered something.
    {"AFullEngineIsAllThatWasWanted",
     fullArrived,
     plain,
     {.full = ofPlain, .shown = full},
     Step::nothing},
    {"WhatWasWaitedForIsALookOfItsOwn",
     fullArrived,
     weighted,
     {.full = ofPlain, .shown = full},
     Step::startCoarseFirst},
    {"WhatWasWaitedForWaitsForTheScanToo",
     fullArrived,
     weighted,
     {.full = ofPlain, .shown = full, .isHeld = true},
     Step::nothing},
    {"LayersThatCameAreShown",
     layersArrived,
     weighted,
     {.full = ofPlain, .layers = ofWeighted, .shown = full},
     Step::showLayers},
    {"LayersOfWeightsThatWentBackAreNotShown",
     layersArrived,
     plain,
     {.full = ofPlain, .layers = ofWeighted, .shown = full},
     Step::nothing},
    {"LayersOfAFormerLookAreNotShown",
     layersArrived,
     classes,
     {.full = ofPlain, .layers = ofWeighted, .shown = full},
     Step::nothing},
    // A job was cancelled or failed.
    {"AfterACoarseOneTheFormerComesBack",
     gaveUp,
     classes,
     {.full = ofPlain, .shown = coarse, .givenUp = ofClasses},
     Step::showFull},
    {"AfterLayersTheFormerComesBack",
     gaveUp,
     weighted,
     {.full = ofPlain, .layers = ofPlain, .shown = live, .givenUp = ofWeighted},
     Step::showFull},
    {"WithoutAFormerTheCoarseOneStays",
     gaveUp,
     plain,
     {.shown = coarse, .givenUp = ofPlain},
     Step::nothing},
    {"WhatIsShownInFullStays",
     gaveUp,
     classes,
     {.full = ofPlain, .shown = full, .givenUp = ofClasses},
     Step::nothing},
};

INSTANTIATE_TEST_SUITE_P(Table, NextStepTable, testing::ValuesIn(table),
                         [](const auto &row) { return std::string(row.param.name); });

TEST(NextStep, AFormerEngineAfterLayersHasTheirBrightness) {
    Have have{.full = ofPlain, .layers = ofPlain, .shown = live};
    EXPECT_EQ(afterStep(Step::showFull, ofPlain, have).shown, settled);
    EXPECT_EQ(afterFull(ofWeighted, have).shown, settled);
    EXPECT_EQ(afterFull(ofClasses, have).shown, full); // its layers are gone
    EXPECT_FALSE(afterFull(ofClasses, have).layers);
    have.shown = coarse;
    EXPECT_EQ(afterFull(ofWeighted, have).shown, full);
}

TEST(NextStep, ACoarseEngineOfWeightsThatMoveHasTheBrightnessOfLayers) {
    const Have have{.full = ofLit, .shown = full, .underway = coarseFirstOf(litWeighted)};
    EXPECT_EQ(afterCoarse(madeFor(litWeighted), have).shown, live);
    EXPECT_EQ(afterCoarse(ofClasses, have).shown, coarse);
    EXPECT_FALSE(afterCoarse(ofClasses, have).underway->isCoarsePending);
}

} // namespace

} // namespace pellucid::prepare
