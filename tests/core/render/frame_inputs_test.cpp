// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/prepare/prepared_engine.h"
#include "core/render/frame_inputs.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

const shading::Shading lit{.cue = {shading::CueKind::linear, 1.0},
                           .ambient = 0.5,
                           .lights = {{{1.0, 0.0, 0.5}, {1.0, 0.5, 0.0}}}};

class FrameInputs : public testing::Test {
protected:
    render::EngineParts partsFor(const shading::Shading &shading) {
        scene::Scene scene;
        scene.camera = camera;
        scene.shading = shading;
        return prepare::prepareEngine({scene, classify::ShownFields{{field}, {}}}).engine->parts();
    }
    render::FrameInputs inputsOf(const render::EngineParts &parts,
                                 const shading::Shading &shading) {
        return render::FrameSetup(parts.fieldOfView)
            .inputsFor(parts.spectra, parts.channelWeights, camera, {}, shading);
    }

    classify::DensityField field =
        test::noiseField(volume::Lattice::centred({12, 12, 12}, {1.0, 1.0, 1.0}));
    scene::Camera camera = scene::defaultCamera(field.values.lattice());
};

TEST_F(FrameInputs, AreEmptyWhereNothingIsShown) {
    render::EngineParts parts = partsFor({});
    parts.channelWeights = {{0.0, 0.0, 0.0}};
    camera.pixelMm = 1e-9; // no slice grid would do
    const render::FrameInputs inputs = inputsOf(parts, {});
    EXPECT_TRUE(inputs.isEmpty());
    EXPECT_EQ(inputs.pictureChannels(), 1);
}

TEST_F(FrameInputs, LightsAreOffWithoutGradients) {
    const render::FrameInputs unlit = inputsOf(partsFor({.cue = lit.cue}), lit),
                              withLight = inputsOf(partsFor(lit), lit);
    EXPECT_FALSE(unlit.shading.lit);
    EXPECT_TRUE(unlit.isShaded);
    EXPECT_EQ(unlit.pictureChannels(), 1);
    EXPECT_TRUE(withLight.shading.lit);
    EXPECT_EQ(withLight.pictureChannels(), 3);
    EXPECT_EQ(withLight.mixing.imageCount, 3);
}

TEST_F(FrameInputs, OneColorIsGivenToTheOneImage) {
    render::EngineParts parts = partsFor({});
    parts.channelWeights = {{0.5, 0.5, 0.5}};
    const render::FrameInputs grey = inputsOf(parts, {});
    EXPECT_EQ(grey.imageColors().front(), (std::array{1.0F, 1.0F, 1.0F}));
    EXPECT_EQ(grey.unit(), 0.5 * grey.geometry.cellArea * grey.mixing.unit);
    parts.channelWeights = {{1.0, 0.5, 0.25}};
    const render::FrameInputs colored = inputsOf(parts, {});
    EXPECT_EQ(colored.pictureChannels(), 3);
    EXPECT_EQ(colored.mixing.imageCount, 1);
    EXPECT_EQ(colored.imageColors().front(), (std::array{1.0F, 0.5F, 0.25F}));
    EXPECT_EQ(colored.unit(), colored.geometry.cellArea * colored.mixing.unit);
    EXPECT_FALSE(colored.isShaded);
}

// Grey, of one hue, in a plane, and of three colors.
TEST_F(FrameInputs, HaveAsManyImagesAsTheColorsHaveRank) {
    render::EngineParts parts = partsFor({});
    parts.spectra.fields.resize(4, parts.spectra.fields.front());
    const render::ChannelWeights white{1.0, 1.0, 1.0}, red{1.0, 0.2, 0.1}, blue{0.1, 0.3, 0.8},
        green{0.1, 0.9, 0.0}, dark{0.5, 0.1, 0.05}, both{1.3, 0.54, 0.92};
    const auto imagesOf = [&](const std::vector<render::ChannelWeights> &weights,
                              const shading::Shading &shading = {}) {
        parts.channelWeights = weights;
        const render::FrameInputs inputs = inputsOf(parts, shading);
        EXPECT_EQ(inputs.mixing.sources.size(), 4U);
        return std::pair(inputs.mixing.imageCount, inputs.pictureChannels());
    };
    using Images = std::pair<int, int>;
    EXPECT_EQ(imagesOf({white, white, {0.5, 0.5, 0.5}, white}), Images(1, 1));
    EXPECT_EQ(imagesOf({red, red, dark, red}), Images(1, 3));
    EXPECT_EQ(imagesOf({red, blue, dark, both}), Images(2, 3)); // 1.2 red and blue
    EXPECT_EQ(imagesOf({red, blue, green, dark}), Images(3, 3));
    EXPECT_EQ(imagesOf({red, blue, dark, both}, {.cue = {shading::CueKind::sine, 1.0}}),
              Images(2, 3));
}

TEST_F(FrameInputs, TheMomentKernelsAreKeptFromFrameToFrame) {
    const render::EngineParts parts = partsFor({.cue = lit.cue});
    render::FrameSetup setup(parts.fieldOfView);
    const auto kernels = [&](const shading::Shading &shading) {
        return setup.inputsFor(parts.spectra, parts.channelWeights, camera, {}, shading)
            .shading.kernels;
    };
    EXPECT_EQ(kernels({}), nullptr);
    const auto *const first = kernels({.cue = lit.cue});
    EXPECT_NE(first, nullptr);
    camera.orientation = scene::viewOrientation(scene::StandardView::back);
    EXPECT_EQ(kernels({.cue = lit.cue}), first);
}

} // namespace
} // namespace pellucid
