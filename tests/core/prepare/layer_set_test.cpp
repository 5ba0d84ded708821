// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/layer_set.h"

#include <gtest/gtest.h>

#include "core/classify/layers.h"
#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/wide_kernel.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using classify::Look;
using render::ChannelWeights;

constexpr classify::FieldWindow window{-900.0, 2000.0};

const volume::Volume &head() {
    static const volume::Volume volume = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{64, 64, 48}}));
    return volume;
}

scene::Scene sceneOf(const volume::Lattice &lattice, fourier::Storage storage) {
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::front, {33, 21, 9});
    scene.interpolation.storage = storage;
    return scene;
}

std::shared_ptr<prepare::LayerSet> layersOf(const scene::Scene &scene, const Look &look,
                                            const plan::Budget &budget = {}) {
    const auto mixture = classify::mixtureOf(look);
    return prepare::LayerSet::prepare(
        scene, mixture.layers.size(),
        [&](std::size_t n, const task::Progress &progress) {
            return classify::layerField(head(), window, mixture.layers[n], nullptr, progress);
        },
        budget);
}

std::vector<float> exactOf(const classify::DensityField &field, const scene::Scene &scene) {
    const auto exact =
        reference::WideKernel(field.values, field.support).image(scene.camera, scene.image);
    return {exact.begin(), exact.end()};
}

Look alternating(int points) {
    Look look;
    look.transferFunction.weights.clear();
    for (int n = 0; n < points; ++n)
        look.transferFunction.weights.push_back(n % 2 == 0 ? 0.0 : 2.0);
    return look;
}

class Layers : public testing::TestWithParam<fourier::Storage> {
protected:
    scene::Scene scene = sceneOf(head().lattice(), GetParam());
    // Two images of the same sum differ by the rounding of binary16 cells, 2.1e-4 for each layer
    // and for the sum, or by the rounding of sums in single precision.
    double rounding = GetParam() == fourier::Storage::binary16 ? 3e-4 : 1e-6;
};

INSTANTIATE_TEST_SUITE_P(Storages, Layers,
                         testing::Values(fourier::Storage::float32, fourier::Storage::binary16));

TEST_P(Layers, AllWeightsOneIsThePlainProjection) {
    const auto layers = layersOf(scene, {});
    const auto plain = classify::densityField(head(), window);
    // The layers' own plan: aliasing is linear too and cancels in the comparison.
    const auto engine = prepare::makeEngine(
        {{plain}, {}, shading::shadingScale(plain.values.lattice()), {}}, layers->plan());
    const auto expected = engine->render(scene.camera, scene.image).samples;
    const std::vector<ChannelWeights> ones(6, {1.0, 1.0, 1.0});
    const auto summed = layers->render(scene.camera, scene.image, {}, ones);
    EXPECT_EQ(summed.channels, 1);
    EXPECT_LE(test::relativeL2(summed.samples, expected), rounding);
    // Again, now from the kept projections.
    const auto kept = layers->render(scene.camera, scene.image, {}, ones);
    EXPECT_LE(test::relativeL2(kept.samples, expected), rounding);
}

TEST_P(Layers, EachBasisProjectionIsWithinTheTolerance) {
    const Look look;
    const auto layers = layersOf(scene, look);
    const auto mixture = classify::mixtureOf(look);
    EXPECT_LE(layers->plan().predictedError, scene.tolerance);
    for (std::size_t n = 0; n < mixture.layers.size(); ++n) {
        std::vector<ChannelWeights> alone(6, {0.0, 0.0, 0.0});
        alone[n] = {1.0, 1.0, 1.0};
        const auto field = classify::layerField(head(), window, mixture.layers[n], nullptr);
        const auto image = layers->render(scene.camera, scene.image, {}, alone).samples;
        EXPECT_LE(test::relativeL2(image, exactOf(field, scene)), scene.tolerance) << n;
    }
}

TEST_P(Layers, SixteenAlternatingPointsAreWithinTheTolerance) {
    const Look look = alternating(16);
    const auto layers = layersOf(scene, look);
    const auto fields = classify::shownFields(head(), window, look, nullptr);
    const auto exact = exactOf(fields.channels.front(), scene);
    const auto channelWeights = classify::mixtureOf(look).channelWeights;
    for (const char *how : {"summed", "kept"})
        EXPECT_LE(test::relativeL2(
                      layers->render(scene.camera, scene.image, {}, channelWeights).samples, exact),
                  scene.tolerance)
            << how;
    const auto settled = prepare::prepareEngine({scene, fields});
    EXPECT_LE(test::relativeL2(settled.engine->render(scene.camera, scene.image).samples, exact),
              scene.tolerance);
}

// A hundred classes: the held one is a layer, the rest are as many as their colors need.
TEST_P(Layers, OfManyClassesTheHeldOneMoves) {
    Look look;
    for (int n = 0; n < 100; ++n)
        look.classes.push_back({"part " + std::to_string(n),
                                20.0 * n - 900.0,
                                20.0 * n - 850.0,
                                30.0,
                                0.5 + 0.01 * n,
                                {0.01 * n, 1.0 - 0.005 * n, n % 7 / 7.0}});
    const std::size_t held = 46; // fluid
    const auto mixture = classify::mixtureOf(look, held);
    ASSERT_EQ(mixture.layers.size(), 4U);
    classify::LayerFields fields(head(), window, mixture, nullptr);
    const auto layers = prepare::LayerSet::prepare(
        scene, fields.count(),
        [&](std::size_t n, const task::Progress &progress) { return fields.field(n, progress); },
        {});
    for (const double weight : {look.classes[held].weight, 0.0, 2.0}) {
        look.classes[held].weight = weight;
        const auto shown = classify::shownFields(head(), window, look, nullptr);
        std::vector<float> exact;
        for (std::size_t c = 0; c < shown.channels.size(); ++c) {
            const auto plane = exactOf(shown.channels[c], scene);
            const classify::Color &color = shown.colors[c];
            exact.resize(3 * plane.size());
            for (std::size_t p = 0; p < plane.size(); ++p) {
                exact[3 * p] += float(color.red) * plane[p];
                exact[3 * p + 1] += float(color.green) * plane[p];
                exact[3 * p + 2] += float(color.blue) * plane[p];
            }
        }
        const auto weights = classify::mixtureOf(look, held).channelWeights;
        for (const char *how : {"summed", "kept"})
            EXPECT_LE(test::relativeL2(
                          layers->render(scene.camera, scene.image, {}, weights).samples, exact),
                      scene.tolerance)
                << how << " " << weight;
    }
}

TEST_P(Layers, RecombinedImagesAreFreshlyRenderedOnes) {
    Look look;
    look.classes = {{"bone", 250, 2500, 150, 1.2, {1.0, 0.9, 0.7}},
                    {"soft", -200, 200, 80, 0.4, {0.2, 0.5, 0.9}},
                    {"fat", -150, -40, 30, 0.0, {1.0, 0.8, 0.2}}};
    const auto layers = layersOf(scene, look);
    const auto fresh = [&](const Look &of, const prepare::LayerSet &like) {
        const auto fields = classify::shownFields(head(), window, of, nullptr);
        return prepare::makeEngine(
                   {fields.channels, {}, shading::shadingScale(head().lattice()), fields.colors},
                   like.plan())
            ->render(scene.camera, scene.image);
    };
    const double allowed = GetParam() == fourier::Storage::binary16 ? 3e-4 : 1e-5;
    layers->render(scene.camera, scene.image, {}, classify::mixtureOf(look).channelWeights);
    for (const double weight : {0.4, 0.0, 1.7}) {
        look.classes[1].weight = weight;
        look.classes[2].weight = weight * 0.5;
        const auto image =
            layers->render(scene.camera, scene.image, {}, classify::mixtureOf(look).channelWeights);
        const auto expected = fresh(look, *layers);
        ASSERT_EQ(image.channels, expected.channels);
        EXPECT_LE(test::relativeL2(image.samples, expected.samples), allowed) << weight;
    }
    // With a single color, the picture is a grey picture times that color.
    look.classes.resize(1);
    const auto single = layersOf(scene, look);
    const auto colored =
        single->render(scene.camera, scene.image, {}, classify::mixtureOf(look).channelWeights);
    ASSERT_EQ(colored.channels, 3);
    const auto expected = fresh(look, *single);
    EXPECT_LE(test::relativeL2(colored.samples, expected.samples), allowed);
}

TEST(LayerSet, WithoutWeightsThePictureIsEmpty) {
    const scene::Scene scene = sceneOf(head().lattice(), fourier::Storage::binary16);
    const auto layers = layersOf(scene, alternating(3));
    const auto image = layers->render(scene.camera, scene.image, {},
                                      std::vector<ChannelWeights>(3, {0.0, 0.0, 0.0}));
    EXPECT_EQ(image.channels, 1);
    EXPECT_TRUE(
        std::all_of(image.samples.begin(), image.samples.end(), [](float f) { return f == 0.0F; }));
}

TEST(LayerSet, IsReducedToTheBudgetOrRefused) {
    const scene::Scene scene = sceneOf(head().lattice(), fourier::Storage::binary16);
    const auto whole = layersOf(scene, {});
    EXPECT_EQ(whole->reduction(), 1);
    const auto half = layersOf(scene, {}, {whole->bytes() / 2});
    EXPECT_GT(half->reduction(), 1);
    EXPECT_LT(half->bytes(), whole->bytes() / 2);
    EXPECT_THROW(layersOf(scene, {}, {1000}), task::Error);
}

// The error of a sum of layers against the study, whether samples were joined or not.
TEST(LayerSet, KnowsTheErrorOfItsSums) {
    const scene::Scene scene = sceneOf(head().lattice(), fourier::Storage::binary16);
    Look look = alternating(4);
    const auto whole = layersOf(scene, look), half = layersOf(scene, look, {whole->bytes() / 2});
    ASSERT_GT(half->reduction(), 1);
    for (const std::vector<double> &weights :
         {std::vector<double>{0, 2, 0, 2}, {0.3, 0.3, 0.3, 0.3}, {0, 0, 1.5, 0}, {1, 0, 0, 2}}) {
        look.transferFunction.weights = weights;
        const auto channelWeights = classify::mixtureOf(look).channelWeights;
        const auto fields = classify::shownFields(head(), window, look, nullptr);
        const auto truth = exactOf(fields.channels.front(), scene);
        for (const auto &layers : {whole, half}) {
            prepare::MixtureEngine engine(layers, channelWeights);
            const auto picture = engine.render(scene.camera, scene.image);
            const auto stated = prepare::measuredError(engine, fields, scene.camera, scene.image);
            const double measured = test::relativeL2(picture.samples, truth);
            EXPECT_GE(1.1 * stated.high, measured);
            EXPECT_LE(stated.low, measured);
        }
    }
}

TEST(LayerSet, IsCancelled) {
    std::stop_source stop;
    stop.request_stop();
    const scene::Scene scene = sceneOf(head().lattice(), fourier::Storage::binary16);
    EXPECT_THROW(prepare::LayerSet::prepare(
                     scene, 2,
                     [&](std::size_t, const task::Progress &) {
                         return classify::densityField(head(), window);
                     },
                     {}, task::Progress(stop.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
