// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/classify/density_field.h"
#include "core/render/frame_model.h"

namespace pellucid {

namespace {

bool isLeftOut(const render::FrameModel &model, render::LeftOut what) {
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
        m_scene.camera = render::defaultCamera(m_lattice);
        m_plan.emplace(render::planRender(m_scene, render::summarise(field)));
    }
    render::FrameModel model(int fields = 1, bool isTinted = false) const {
        return render::modelFrame(*m_plan, m_scene, fields, isTinted, m_lattice);
    }

    volume::Lattice m_lattice = volume::Lattice::centred({32, 32, 32}, {1, 1, 1});
    render::Scene m_scene;
    std::optional<render::RenderPlan> m_plan;
};

TEST_F(FrameModel, APlainGreyFrameIsOneSliceOfOneSpectrum) {
    const auto plain = model();
    EXPECT_EQ(plain.fields + plain.gradients, 1);
    EXPECT_EQ(plain.slices, 1);
    EXPECT_EQ(plain.images, 1);
    EXPECT_EQ(plain.combination, render::Combination::one);
    EXPECT_EQ(plain.spectrumBytes, m_plan->spectrum.bytes());
    for (const auto what : {render::LeftOut::light, render::LeftOut::depthCue,
                            render::LeftOut::color, render::LeftOut::emptySpace})
        EXPECT_TRUE(isLeftOut(plain, what)) << render::leftOutText(what);
}

TEST_F(FrameModel, LightTakesASpectrumOfTheGradientAndASineCueTwoMoreSlices) {
    const auto plain = model();
    m_scene.shading.lights.emplace_back();
    const auto lit = model();
    EXPECT_EQ(lit.gradients, 1);
    EXPECT_EQ(lit.slices, 2);
    EXPECT_FALSE(isLeftOut(lit, render::LeftOut::light));
    EXPECT_DOUBLE_EQ(lit.multiplyAdds, 2.0 * plain.multiplyAdds);
    m_scene.shading.cue = {shading::CueKind::sine, 1.0, {}};
    const auto cued = model();
    EXPECT_EQ(cued.slices, 6);
    EXPECT_FALSE(isLeftOut(cued, render::LeftOut::depthCue));
}

TEST_F(FrameModel, ColoursTakeThreeImagesAndATintTakesNone) {
    EXPECT_EQ(model(1, true).combination, render::Combination::tinted);
    EXPECT_EQ(model(1, true).images, 1);
    const auto colored = model(3);
    EXPECT_EQ(colored.combination, render::Combination::channels);
    EXPECT_EQ(colored.images, 3);
    EXPECT_EQ(colored.slices, 3);
    EXPECT_FALSE(isLeftOut(colored, render::LeftOut::color));
    EXPECT_DOUBLE_EQ(colored.transformOperations, 3.0 * model().transformOperations);
}

} // namespace
} // namespace pellucid
