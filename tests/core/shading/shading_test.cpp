// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shading/shading.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/shading/gradient_magnitude.h"
#include "core/shading/slice_shading.h"
#include "core/task/error.h"
#include "tests/support/fields.h"
#include "tests/support/json_text.h"

namespace pellucid {

namespace {

using shading::CueKind;
using shading::DepthCue;
using shading::Light;
using shading::LightFrame;
using shading::Shading;

TEST(DepthCue, IsWhatItsKindSays) {
    const DepthCue linear{CueKind::linear, 0.4}, sine{CueKind::sine, 0.6};
    EXPECT_DOUBLE_EQ(linear.at(-1.0), 0.6);
    EXPECT_DOUBLE_EQ(linear.at(0.5), 1.2);
    EXPECT_DOUBLE_EQ(sine.at(1.0), 1.6);
    EXPECT_DOUBLE_EQ(sine.at(-1.0), 0.4);
    EXPECT_NEAR(sine.at(1.0 / 3.0), 1.3, 1e-15); // sin 30 degrees
    EXPECT_DOUBLE_EQ(DepthCue().at(0.7), 1.0);
}

// The cosine series passes through the values, and values of one cosine give that cosine alone.
TEST(DepthCue, ACurveGoesThroughItsValues) {
    const std::vector<double> values{0.2, 1.9, 0.0, 0.7, 1.0};
    const DepthCue curve{CueKind::curve, 1.0, values};
    for (std::size_t n = 0; n < values.size(); ++n)
        EXPECT_NEAR(curve.at(0.5 * double(n) - 1.0), values[n], 1e-12);
    const auto slab = shading::cosinesOf({0.0, 2.0, 0.0});
    EXPECT_NEAR(slab[0], 1.0, 1e-15);
    EXPECT_EQ(slab[1], 0.0); // two slices less
    EXPECT_NEAR(slab[2], -1.0, 1e-15);
    EXPECT_FALSE((DepthCue{CueKind::curve, 1.0, {1.0, 1.0}}.isActive()));
    EXPECT_FALSE((DepthCue{CueKind::linear, 0.0}.isActive()));
}

// The terms of the slices and the slope are the cue: on any line along W.
TEST(SliceShading, TermsAddUpToTheCue) {
    const glm::dmat3 axes =
        glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    const shading::ShadingScale scale{130.0, 0.8};
    for (const DepthCue &cue : {DepthCue{CueKind::linear, 0.7}, DepthCue{CueKind::sine, 0.9},
                                DepthCue{CueKind::curve, 0.8, {0.0, 1.5, 0.3, 2.0}}}) {
        const auto slices = shading::sliceShading({.cue = cue}, axes, scale);
        for (const double depthMm : {-130.0, -31.0, 0.0, 57.0, 130.0}) {
            std::complex<double> sum = slices.slope * depthMm;
            for (const auto &term : slices.terms)
                sum +=
                    term.weight * std::polar(1.0, -2.0 * std::numbers::pi * term.offset * depthMm);
            EXPECT_NEAR(sum.real(), cue.at(depthMm / scale.radiusMm), 1e-12);
            EXPECT_NEAR(sum.imag(), 0.0, 1e-12);
        }
    }
}

TEST(SliceShading, LightsCollapseIntoOneGradientAChannel) {
    const glm::dmat3 axes =
        glm::mat3_cast(glm::angleAxis(1.1, glm::normalize(glm::dvec3(3, -1, 2))));
    Light red{{2, 0, 0}, {1.0, 0.5, 0.0}, 0.5}, fixed{{0, 0, -3}, {0.0, 0.0, 1.0}};
    fixed.frame = LightFrame::patient;
    const auto slices = shading::sliceShading({.ambient = 0.3, .lights = {red, fixed}}, axes, {});
    EXPECT_FALSE(slices.isGrey());
    EXPECT_NEAR(slices.channels[0].magnitude, 0.25, 1e-15);
    EXPECT_NEAR(slices.channels[2].magnitude, 0.5, 1e-15);
    // Against the light: the gradient points into matter.
    EXPECT_LT(glm::distance(slices.channels[1].gradient, -0.125 * axes[0]), 1e-15);
    EXPECT_LT(glm::distance(slices.channels[2].gradient, glm::dvec3(0, 0, 0.5)), 1e-15);
    EXPECT_TRUE(shading::sliceShading({}, axes, {}).isPlain());
}

// Central differences are exact for a linear field, whatever the lattice.
TEST(GradientMagnitude, OfALinearFieldIsItsSlope) {
    const auto lattice = test::tiltedLattice({9, 8, 7}, {0.8, 1.1, 2.5}, 20.0);
    const glm::dvec3 slope(0.01, -0.02, 0.03); // per mm
    std::vector<float> samples;
    for (int k = 0; k < 7; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 9; ++i)
                samples.push_back(
                    float(5.0 + glm::dot(slope, lattice.patient(volume::VoxelIndex{i, j, k}).mm)));
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const glm::dvec3 g = shading::gradientAt(field, {4, 4, 3}, 0.8);
    EXPECT_LT(glm::distance(g, 0.8 * slope), 1e-6);
}

// No sample is darker than black in any direction: the length and the direction agree. The vector
// code equals the formula.
TEST(GradientMagnitude, IsNowhereShorterThanTheGradientAlongAnyDirection) {
    const auto noise = test::noiseField(test::tiltedLattice({6, 7, 5}, {1, 1.2, 3}, 15.0));
    EXPECT_FALSE(shading::holdsGradient(noise));
    const auto larger = shading::grown(noise);
    ASSERT_TRUE(shading::holdsGradient(larger));
    EXPECT_LT(
        glm::distance(larger.values.lattice().center().mm, noise.values.lattice().center().mm),
        1e-12);
    const auto length = shading::gradientMagnitude(larger, 1.0);
    const volume::GridSize size = larger.values.lattice().size();
    double most = 0.0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const double expected =
                    glm::length(shading::gradientAt(larger.values, {i, j, k}, 1.0));
                EXPECT_NEAR(length.values.value({i, j, k}), expected, 1e-6);
                most = std::max(most, i == 0 || k == 0 ? expected : 0.0);
            }
    EXPECT_GT(most, 0.1); // the field's faces have gradients beyond them
    EXPECT_EQ(length.support, larger.values.lattice().bounds());
}

TEST(Shading, GoesThroughJson) {
    Shading shading{.cue = {CueKind::curve, 0.5, {0.0, 1.0, 2.0, 0.5}},
                    .ambient = 0.3,
                    .lights = {{{1, -2, 0.5}, {1.0, 0.2, 0.0}, 0.25}, {}}};
    shading.lights[1].frame = LightFrame::patient;
    EXPECT_EQ(test::readJson<shading::Shading>(test::jsonText(shading)), shading);
    EXPECT_EQ(test::jsonText(Shading()), "{}");
    EXPECT_EQ(test::readJson<shading::Shading>("{}"), Shading());
}

TEST(Shading, NumbersAreReadAsTheyAreTyped) {
    EXPECT_EQ(shading::lightFromText("0, +1, -.5:#ff0000: 0.5"),
              (Light{{0.0, 1.0, -0.5}, {1.0, 0.0, 0.0}, 0.5}));
    EXPECT_EQ(shading::cueFromText("curve:0, 2,+0.5"),
              (shading::DepthCue{CueKind::curve, 1.0, {0.0, 2.0, 0.5}}));
    for (const char *text : {"linear:", "linear:x", "linear:inf", "linear:nan", "linear:0.5 ",
                             "linear:0,5", "curve:1,,2", "curve:1,2,"})
        EXPECT_THROW(shading::cueFromText(text), task::Error) << text;
}

TEST(Shading, BadJsonIsRefusedWithItsPlace) {
    const auto refuse = [](const std::string &text, const std::string &reason) {
        try {
            test::readJson<shading::Shading>(text);
            ADD_FAILURE() << text;
        } catch (const task::Error &error) {
            const std::string found = error.reason().english();
            EXPECT_EQ(found.rfind(reason, 0), 0U) << found;
        }
    };
    refuse("[]", "must be an object");
    refuse(R"({"cue": "linear"})", "/cue: must be an object");
    refuse(R"({"cue": {"kind": "cubic"}})", "/cue/kind: unknown value 'cubic': use one of");
    refuse(R"({"cue": {"kind": "linear", "strength": 2}})", "/cue: the strength");
    refuse(R"({"cue": {"kind": "curve", "curve": [1]}})", "/cue: the curve");
    refuse(R"({"ambient": -1})", "/ambient: the ambient light");
    refuse(R"({"lights": {}})", "/lights: must be a list");
    refuse(R"({"lights": [{}]})", "/lights/0: has no direction");
    refuse(R"({"lights": [{"direction": [1, 2]}]})", "/lights/0/direction: must be three");
    refuse(R"({"lights": [{"direction": [1, 2, 1e999]}]})", "must be an object");
    refuse(R"({"lights": [{"direction": [1, 2, 1e31]}]})", "/lights/0/direction/2: is out of");
    refuse(R"({"lights": [{"direction": [0, 0, 0]}]})", "/lights/0: the direction");
    refuse(R"({"lights": [{"direction": [1, 0, 0], "color": "red"}]})", "/lights/0/color: ");
    refuse(R"({"lights": [{"direction": [1, 0, 0], "follows": "me"}]})",
           "/lights/0/follows: unknown value 'me'");
}

} // namespace
} // namespace pellucid
