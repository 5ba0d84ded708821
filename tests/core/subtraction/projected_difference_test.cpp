// SPDX-License-Identifier: GPL-3.0-or-later
// Projecting is linear: the picture of a difference is the difference of the pictures.
#include <cmath>

#include <gtest/gtest.h>

#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "core/preprocess/step_cache.h"
#include "core/reference/shaded_field.h"
#include "core/subtraction/difference.h"
#include "core/task/error.h"

namespace pellucid {
namespace {

using volume::GridSize;
using volume::Volume;

// The head after contrast has come into one block of it, and something else has left another.
Volume later(const Volume &before) {
    return before.visit([&](auto samples) {
        std::vector<std::int16_t> values(samples.begin(), samples.end());
        const GridSize size = before.lattice().size();
        const auto add = [&](int first, int by) {
            for (int k = 14; k < 22; ++k)
                for (int j = 16; j < 30; ++j)
                    for (int i = first; i < first + 9; ++i)
                        values[size.offsetOf(i, j, k)] += std::int16_t(by);
        };
        add(14, 300);
        add(30, -120);
        return Volume(before.lattice(), std::move(values), before.unit(), before.notes());
    });
}

TEST(ProjectedDifference, IsTheDifferenceOfTheExactProjections) {
    const Volume before = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{40, 36, 24}}));
    const Volume after = later(before);
    const Volume difference = subtraction::difference(after, before);
    // Wide enough that no value of either volume is clamped.
    constexpr classify::FieldWindow all{-2000.0, 4000.0};
    constexpr classify::FieldWindow gained{0.0, 6000.0}; // of the same width
    classify::Look gain{{}, {classify::differenceClasses()[0]}},
        loss{{}, {classify::differenceClasses()[1]}};
    gain.classes[0].color = loss.classes[0].color = {};
    scene::Scene scene;
    scene.camera = scene::defaultCamera(before.lattice());
    preprocess::StepCache steps(std::size_t(1) << 26);
    scene.camera.orientation =
        scene::viewOrientation(scene::StandardView::front, {20.0, 10.0, 5.0});
    const auto exactOf = [&](const Volume &volume) {
        return reference::shadedImage({{classify::densityField(volume, all)}, {}}, {}, scene.camera,
                                      scene.image);
    };
    const std::vector<double> a = exactOf(after), b = exactOf(before);
    for (const double tolerance : {1e-2, 1.1e-3, 1e-4}) {
        scene.tolerance = tolerance;
        const auto of = [&](const classify::Look &look) {
            auto fields = classify::shownFields(difference, gained, look, &steps);
            const auto prepared = prepare::prepareEngine({scene, std::move(fields)});
            return prepared.engine->render(scene.camera, scene.image).samples;
        };
        const auto more = of(gain), less = of(loss);
        ASSERT_EQ(more.size(), a.size());
        double error = 0.0, ofMore = 0.0, ofLess = 0.0;
        for (std::size_t n = 0; n < a.size(); ++n) {
            const double shown = double(more[n]) - double(less[n]);
            error += std::pow(shown - (a[n] - b[n]), 2);
            ofMore += std::pow(double(more[n]), 2);
            ofLess += std::pow(double(less[n]), 2);
        }
        EXPECT_GT(ofMore, ofLess);
        EXPECT_GT(ofLess, 0.0);
        EXPECT_LE(std::sqrt(error), tolerance * (std::sqrt(ofMore) + std::sqrt(ofLess)))
            << tolerance;
    }
}

// Weights mix two volumes sample by sample, exactly where the numbers are whole.
TEST(ProjectedDifference, OfWeightedVolumes) {
    const Volume before = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{24, 20, 12}}));
    const Volume after = later(phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{40, 36, 24}})));
    const Volume twice = subtraction::difference(before, before, {}, {2.0, -1.0});
    EXPECT_FALSE(twice.isFloat());
    EXPECT_EQ(twice.value({12, 10, 6}), before.value({12, 10, 6}));
    const Volume half = subtraction::difference(before, before, {}, {1.0, -0.25});
    EXPECT_NEAR(half.value({12, 10, 6}), 0.75 * before.value({12, 10, 6}), 1e-4);
    const Volume sum = subtraction::difference(before, after, {}, {0.0, 1.0});
    const Volume aligned = subtraction::onLatticeOf(before, after, {});
    EXPECT_EQ(aligned.unit(), volume::ValueUnit::hounsfield);
    EXPECT_EQ(aligned.lattice(), before.lattice());
    EXPECT_NEAR(aligned.value({12, 10, 6}), sum.value({12, 10, 6}), 1e-3);
    EXPECT_THROW(subtraction::difference(before, before, {}, {1.0, -2.5}), task::Error);
    EXPECT_THROW(subtraction::difference(before, before, {}, {std::nan(""), -1.0}), task::Error);
}

} // namespace
} // namespace pellucid
