// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/classify/density_field.h"
#include "core/plan/frame_model.h"

namespace pellucid {

namespace {

using plan::SpectrumOf;

bool isLeftOut(const plan::FrameModel &model, plan::LeftOut what) {
    return std::find(model.leftOut.begin(), model.leftOut.end(), what) != model.leftOut.end();
}

class FrameModel : public testing::Test {
protected:
    FrameModel() {
        std::vector<float> samples(m_lattice.size().count(), 0.0F);
        for (std::size_t n = 0; n < samples.size() / 2; ++n)
            samples[n] = 0.5F;
        const auto field = classify::densityField(
            volume::Volume(m_lattice, std::move(samples), volume::ValueUnit::none), {0.0, 1.0});
        m_scene.camera = scene::defaultCamera(m_lattice);
        m_plan.emplace(plan::planRender(m_scene, field::summarise(field)));
    }
    plan::FrameModel model(const plan::FrameFields &fields = {}) const {
        return plan::modelFrame(*m_plan, m_scene, fields, m_lattice);
    }

    volume::Lattice m_lattice = volume::Lattice::centred({32, 32, 32}, {1, 1, 1});
    scene::Scene m_scene;
    std::optional<plan::RenderPlan> m_plan;
};

TEST_F(FrameModel, APlainGreyFrameIsOneSliceOfOneSpectrum) {
    const auto plain = model();
    ASSERT_EQ(plain.spectra.size(), 1U);
    EXPECT_EQ(plain.spectra.front().of, SpectrumOf::look);
    EXPECT_EQ(plain.spectra.front().count, 1);
    EXPECT_EQ(plain.slices, 1);
    EXPECT_EQ(plain.images, 1);
    EXPECT_EQ(plain.combination, plan::Combination::one);
    EXPECT_EQ(plain.spectrumBytes, m_plan->spectrum.bytes());
    for (const auto what : {plan::LeftOut::light, plan::LeftOut::depthCue, plan::LeftOut::color,
                            plan::LeftOut::emptySpace})
        EXPECT_TRUE(isLeftOut(plain, what)) << plan::leftOutText(what);
}

TEST_F(FrameModel, LightTakesASpectrumOfTheGradientAndASineCueTwoMoreSlices) {
    const auto plain = model();
    m_scene.shading.lights.emplace_back();
    const auto lit = model();
    ASSERT_EQ(lit.spectra.size(), 2U);
    EXPECT_EQ(lit.spectra.back().of, SpectrumOf::gradient);
    EXPECT_EQ(lit.spectra.back().count, 1);
    EXPECT_EQ(lit.slices, 2);
    EXPECT_FALSE(isLeftOut(lit, plan::LeftOut::light));
    EXPECT_DOUBLE_EQ(lit.multiplyAdds, 2.0 * plain.multiplyAdds);
    m_scene.shading.cue = {shading::CueKind::sine, 1.0, {}};
    const auto cued = model();
    EXPECT_EQ(cued.slices, 6);
    EXPECT_FALSE(isLeftOut(cued, plan::LeftOut::depthCue));
}

TEST_F(FrameModel, MixedColorsTakeTwoOrThreeImagesAndATintOne) {
    const auto tinted = model({1, SpectrumOf::look, 1});
    EXPECT_EQ(tinted.combination, plan::Combination::tinted);
    EXPECT_EQ(tinted.images, 1);
    const auto mixed = model({2, SpectrumOf::color, 2});
    EXPECT_EQ(mixed.combination, plan::Combination::mixed);
    EXPECT_EQ(mixed.images, 2);
    EXPECT_EQ(mixed.slices, 2);
    const auto colored = model({3, SpectrumOf::color, 3});
    EXPECT_EQ(colored.combination, plan::Combination::channels);
    EXPECT_EQ(colored.images, 3);
    EXPECT_EQ(colored.slices, 3);
    EXPECT_FALSE(isLeftOut(colored, plan::LeftOut::color));
    EXPECT_DOUBLE_EQ(colored.transformOperations, 3.0 * model().transformOperations);
}

// Slices of layers add up before the transform: two or five grey ones make one image, and those of
// two or three colors two or three.
TEST_F(FrameModel, LayersTakeASliceEachAndNoImage) {
    for (const int count : {2, 5}) {
        const auto grey = model({count, SpectrumOf::layer, 0});
        EXPECT_EQ(grey.spectra.front().of, SpectrumOf::layer);
        EXPECT_EQ(grey.slices, count);
        EXPECT_EQ(grey.images, 1);
        EXPECT_TRUE(isLeftOut(grey, plan::LeftOut::color));
        for (const int colors : {2, 3})
            EXPECT_EQ(model({count, SpectrumOf::layer, colors}).images, colors);
    }
}

TEST_F(FrameModel, ColoredLightMakesThreeImagesOfAGreyField) {
    m_scene.shading.lights.emplace_back();
    EXPECT_EQ(model().images, 1);
    m_scene.shading.lights.front().color = {1.0, 0.6, 0.2};
    EXPECT_EQ(model().images, 3);
    EXPECT_EQ(model().combination, plan::Combination::channels);
}

// The frame is that of the scene's camera: half the pixels, about half the work.
TEST_F(FrameModel, TheFrameHasTheSizeOfTheCamera) {
    const auto whole = model();
    m_scene.camera.width /= 2;
    m_scene.camera.panMm = {};
    const auto part = model();
    EXPECT_LT(part.multiplyAdds, whole.multiplyAdds);
    EXPECT_LT(part.frameBytes, whole.frameBytes);
    EXPECT_EQ(part.spectrumBytes, whole.spectrumBytes);
}

} // namespace
} // namespace pellucid
