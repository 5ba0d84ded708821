// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/accuracy/narrowing_error.h"
#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using render::ChannelWeights;

class NarrowingError : public testing::TestWithParam<phantom::Kind> {
public:
    struct Comparison {
        double estimated, measured;   ///< energies of all channels
        double worstPixel, predicted; ///< relative to the largest pixel
        double relativeL2, allowedL2;
    };

    // A picture by several widths beside that of one kernel.
    static Comparison compare(const shading::Shading &shading, const ChannelWeights &color,
                              double tolerance) {
        const auto lattice =
            phantom::phantomLattice(GetParam(), {.size = volume::GridSize{96, 96, 40}});
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        scene.camera.orientation =
            scene::viewOrientation(scene::StandardView::front, {35.0, 20.0, 5.0});
        return compareField(
            classify::densityField(phantom::makePhantom(GetParam(), lattice), {-900.0, 2000.0}),
            scene, shading, color, tolerance);
    }

    static Comparison compareField(const classify::DensityField &field, scene::Scene scene,
                                   const shading::Shading &shading, const ChannelWeights &color,
                                   double tolerance) {
        // With a linear cue, only frequencies beyond the field's own band are left out: they are in
        // pictures finer than the voxels.
        if (shading.cue.hasMoments()) {
            scene.camera.pixelMm /= 3.0;
            scene.camera.width *= 3;
            scene.camera.height *= 3;
        }
        scene.tolerance = tolerance;
        scene.shading = shading;
        const auto prepared = prepare::prepareEngine(
            scene, classify::ShownFields{{field}, {{{color[0], color[1], color[2]}}}}, {});
        auto parts = prepared.engine->parts();
        const auto narrow = prepared.engine->render(scene.camera, scene.image, scene.shading);
        render::CpuEngine whole(parts.spectra, parts.fieldOfView);
        whole.setChannelWeights(parts.channelWeights);
        const auto wide = whole.render(scene.camera, scene.image, scene.shading);
        render::FrameSetup setup(parts.fieldOfView, parts.widths);
        const auto inputs = setup.inputsFor(parts.spectra, parts.channelWeights, scene.camera,
                                            scene.image, scene.shading);
        const auto energies =
            accuracy::narrowingEnergies(parts.spectra, inputs, scene.camera, scene.image);
        Comparison found{
            0.0, 0.0, 0.0, prepared.plan.predictedMaximum, 0.0, prepared.plan.adaptiveError};
        for (int c = 0; c < narrow.channels; ++c)
            found.estimated += energies[std::size_t(c)];
        double largest = 0.0, energy = 0.0;
        for (std::size_t n = 0; n < wide.samples.size(); ++n) {
            const double off = double(narrow.samples[n]) - double(wide.samples[n]);
            found.measured += off * off * scene.camera.pixelMm * scene.camera.pixelMm;
            energy += double(wide.samples[n]) * double(wide.samples[n]) * scene.camera.pixelMm *
                      scene.camera.pixelMm;
            found.worstPixel = std::max(found.worstPixel, std::abs(off));
            largest = std::max(largest, double(wide.samples[n]));
        }
        found.worstPixel /= largest;
        found.relativeL2 = std::sqrt(found.measured / energy);
        return found;
    }
};

TEST_P(NarrowingError, IsEstimatedFromASample) {
    shading::Shading lit, sine;
    lit.ambient = 0.4;
    lit.lights.resize(1);
    lit.lights[0].direction = {0.3, 0.5, 1.0};
    lit.lights[0].color = {1.0, 0.7, 0.4};
    sine.cue.kind = shading::CueKind::sine;
    sine.cue.strength = 0.8;
    for (const double tolerance : {1e-2, 1e-3})
        for (const shading::Shading &shading : {shading::Shading(), lit, sine})
            for (const ChannelWeights &color :
                 {ChannelWeights{1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, {0.9, 0.4, 0.1}}) {
                const Comparison found = compare(shading, color, tolerance);
                // The estimate includes twice its standard error. The error spreads over the whole
                // period, of which the picture shows a third or more.
                EXPECT_GT(found.estimated, 0.75 * found.measured)
                    << tolerance << " " << color[1] << " " << toJson(shading);
                EXPECT_LT(found.estimated, 3.5 * found.measured)
                    << tolerance << " " << color[1] << " " << toJson(shading);
                EXPECT_GT(found.relativeL2, 0.0);
                EXPECT_LE(found.relativeL2, found.allowedL2)
                    << tolerance << " " << color[1] << " " << toJson(shading);
            }
}

// Tiles that are left out without being measured count with a bound.
TEST_P(NarrowingError, OfALinearCueIsNoMoreThanEstimatedAndAllowed) {
    const shading::Shading linear{.cue = {shading::CueKind::linear, 0.9}};
    shading::Shading lit = linear;
    lit.ambient = 0.4;
    lit.lights.resize(1);
    lit.lights[0].direction = {0.3, 0.5, 1.0};
    for (const double tolerance : {1e-2, 1e-3})
        for (const shading::Shading &shading : {linear, lit}) {
            const Comparison found = compare(shading, {1.0, 1.0, 1.0}, tolerance);
            EXPECT_GE(found.estimated, 0.75 * found.measured) << tolerance << toJson(shading);
            EXPECT_LE(found.relativeL2, found.allowedL2) << tolerance << toJson(shading);
            if (tolerance == 1e-2) {
                EXPECT_GT(found.relativeL2, 0.0) << toJson(shading);
            }
        }
}

TEST_P(NarrowingError, TheWorstPixelIsWithinWhatThePlanPredicts) {
    for (const double tolerance : {3e-2, 1e-2, 1e-3}) {
        const Comparison found = compare({}, {1.0, 1.0, 1.0}, tolerance);
        EXPECT_GT(found.worstPixel, 0.0);
        EXPECT_LE(found.worstPixel, found.predicted) << tolerance;
    }
}

// The texture of one half cancels that of the other along the line of sight, but not under a cue
// along it: where the slice is dark, the cued slice is not.
TEST(LinearCue, LeavesOutNoMoreThanAllowedWhereOnlyTheCuedSliceHasEnergy) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1.0, 1.0, 1.0});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> even(-0.45F, 0.45F);
    std::vector<float> texture(64 * 64), samples(lattice.size().count());
    for (float &value : texture)
        value = even(random);
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] = 0.5F + (n / (64 * 64) < 32 ? -1.0F : 1.0F) * texture[n % (64 * 64)];
    const auto field = classify::fieldOf(volume::Volume(lattice, samples, volume::ValueUnit::none));
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::top);
    for (const double tolerance : {1e-1, 3e-2, 1e-2, 1e-3}) {
        const auto found = NarrowingError::compareField(
            field, scene, {.cue = {shading::CueKind::linear, 0.9}}, {1.0, 1.0, 1.0}, tolerance);
        EXPECT_LE(found.relativeL2, found.allowedL2) << tolerance;
        if (tolerance == 1e-1) {
            EXPECT_GT(found.relativeL2, 0.0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Phantoms, NarrowingError,
                         testing::Values(phantom::Kind::head, phantom::Kind::chest),
                         [](const auto &test) {
                             return test.param == phantom::Kind::head ? "head" : "chest";
                         });

} // namespace
} // namespace pellucid
