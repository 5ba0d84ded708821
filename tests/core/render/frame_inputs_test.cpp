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
        return prepare::prepareEngine(scene, {{field}, {}}, {}).engine->parts();
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
    EXPECT_EQ(withLight.mixing.channels, 3);
}

TEST_F(FrameInputs, OneColorIsGivenToTheOneImage) {
    render::EngineParts parts = partsFor({});
    parts.channelWeights = {{0.5, 0.5, 0.5}};
    const render::FrameInputs grey = inputsOf(parts, {});
    EXPECT_EQ(grey.tint(), (render::ChannelWeights{1.0, 1.0, 1.0}));
    EXPECT_EQ(grey.unit(), 0.5 * grey.geometry.cellArea * grey.mixing.unit);
    parts.channelWeights = {{1.0, 0.5, 0.25}};
    const render::FrameInputs colored = inputsOf(parts, {});
    EXPECT_EQ(colored.pictureChannels(), 3);
    EXPECT_EQ(colored.mixing.channels, 1);
    EXPECT_EQ(colored.tint(), parts.channelWeights.front());
    EXPECT_EQ(colored.unit(), colored.geometry.cellArea * colored.mixing.unit);
    EXPECT_FALSE(colored.isShaded);
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
