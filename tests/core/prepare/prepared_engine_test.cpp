// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/phantom/phantom.h"
#include "core/prepare/layer_set.h"
#include "core/prepare/prepared_engine.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

classify::ShownFields headFields(const volume::GridSize &size) {
    const auto lattice = phantom::phantomLattice(phantom::Kind::head, {.size = size});
    const auto head = phantom::makePhantom(phantom::Kind::head, lattice);
    return {{classify::densityField(head, {-900.0, 2000.0})}, {}};
}

scene::Scene sceneOf(const classify::ShownFields &fields) {
    scene::Scene scene;
    scene.camera = scene::defaultCamera(fields.channels.front().values.lattice());
    return scene;
}

TEST(PreparedEngine, TheExactReferenceKeepsAToleranceThatNoPlanKeeps) {
    const classify::ShownFields fields = headFields({24, 24, 24});
    scene::Scene scene = sceneOf(fields);
    scene.tolerance = scene::referenceTolerance;
    const auto exact =
        prepare::prepareEngine({.scene = scene, .fields = fields, .mayBeExact = true});
    ASSERT_TRUE(exact.exact);
    EXPECT_FALSE(exact.engine);
    EXPECT_TRUE(prepare::prepareEngine({.scene = scene, .fields = fields}).engine);
    // A scene that sets the interpolation gets it.
    scene.interpolation.padding = 2.0;
    EXPECT_TRUE(
        prepare::prepareEngine({.scene = scene, .fields = fields, .mayBeExact = true}).engine);
}

TEST(PreparedEngine, WhatDoesNotFitIsReducedOrRefused) {
    const classify::ShownFields fields = headFields({96, 96, 96});
    const scene::Scene scene = sceneOf(fields);
    const auto whole = prepare::prepareEngine({.scene = scene, .fields = fields});
    EXPECT_FALSE(whole.isCoarse);
    EXPECT_TRUE(prepare::boundOf(whole, scene.image));
    const std::size_t little = whole.plan.bytes / 8;
    const auto coarse =
        prepare::prepareEngine({.scene = scene, .fields = fields, .budget = {little}});
    EXPECT_TRUE(coarse.isCoarse);
    EXPECT_LE(coarse.plan.bytes, little);
    EXPECT_FALSE(prepare::boundOf(coarse, scene.image)); // what it lacks is measured
    EXPECT_THROW(prepare::prepareEngine(
                     {.scene = scene, .fields = fields, .budget = {little, /*decides*/ false}}),
                 task::Error);
    const plan::Budget enough{whole.plan.bytes, /*decides*/ false};
    EXPECT_FALSE(
        prepare::prepareEngine({.scene = scene, .fields = fields, .budget = enough}).isCoarse);
}

// Amplified detail raises the bound of the plan and of the picture by the same factor.
TEST(PreparedEngine, TheBoundIsThePlansForEveryAmountOfDetail) {
    const classify::ShownFields fields = headFields({32, 32, 32});
    scene::Scene scene = sceneOf(fields);
    for (const double detail : {0.28, 0.41, 0.82}) {
        scene.image.detail = detail;
        const auto prepared = prepare::prepareEngine({.scene = scene, .fields = fields});
        EXPECT_EQ(prepare::boundOf(prepared, scene.image)->relative, prepared.plan.predictedError);
    }
}

// Means of the long axes alone save less than means of all three.
TEST(LayerSet, ThinLayersAreReducedUntilTheyFit) {
    const classify::ShownFields fields = headFields({128, 128, 10});
    const scene::Scene scene = sceneOf(fields);
    constexpr std::size_t count = 6;
    const auto layersIn = [&](const plan::Budget &budget) {
        return prepare::LayerSet::prepare(
            scene, count,
            [&](std::size_t, const task::Progress &) { return fields.channels.front(); }, budget);
    };
    const std::size_t bytes = fields.channels.front().values.samples().bytes();
    const auto reduced = layersIn({4 * count * bytes});
    EXPECT_GT(reduced->reduction(), 1);
}

} // namespace
} // namespace pellucid
