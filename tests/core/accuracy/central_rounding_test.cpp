// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/central_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/prepare/prepared_engine.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using classify::Color;
using classify::DensityField;

// A smooth blob: nearly all of its energy lies in the cells around frequency 0 whose rounding is
// kept, so what 16-bit cells change in a picture is their rounding.
DensityField blob() {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1.0, 1.1, 0.9});
    const glm::dvec3 middle(2.0, -1.0, 1.5);
    return classify::densityField(
        test::volumeOf(lattice,
                       [&](const glm::dvec3 &at) {
                           const double r = glm::length(at - middle) / 16.0;
                           return r < 1.0 ? std::pow(std::cos(0.5 * 3.14159265358979 * r), 2) : 0.0;
                       }),
        {0.0, 1.0});
}

struct Case {
    const char *name;
    shading::Shading shading;
    double zoom = 1.0;
    bool isCropped = false;
};

shading::Shading cued(shading::CueKind kind) {
    shading::Shading shading;
    shading.cue = {kind, 0.8, {0.2, 1.0, 0.4}};
    return shading;
}

shading::Shading lit(shading::Shading shading, const Color &color) {
    shading.ambient = 0.4;
    shading.lights.push_back({{-1.0, 1.0, 0.5}});
    shading.lights.back().color = color;
    return shading;
}

class CentralRounding : public testing::TestWithParam<Case> {};

TEST_P(CentralRounding, IsTheDifferenceThat16BitCellsMake) {
    const Case &p = GetParam();
    scene::Scene scene;
    const DensityField field = blob();
    scene.camera = scene::defaultCamera(field.values.lattice());
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::front, {33, 21, 9});
    scene.camera.pixelMm /= p.zoom;
    if (p.isCropped) {
        scene.camera.width = scene.camera.height = 24;
        scene.camera.panMm = {4.0, -3.0};
    }
    scene.shading = p.shading;
    scene.interpolation = {fourier::kernelFromName("LS4"), 1.5, fourier::Storage::binary16};
    const auto shaded = prepare::shadedFields({{field}, {}}, scene.shading,
                                              shading::shadingScale(field.values.lattice()));
    const auto summaries = prepare::summarise(shaded, scene.shading.cue);
    const auto engineWith = [&](fourier::Storage storage) {
        scene.interpolation.storage = storage;
        const auto plan =
            plan::planRender(scene, summaries, prepare::compositionOf(1, scene.shading));
        return std::pair(prepare::makeEngine(shaded, plan), plan);
    };
    const auto [rounded, plan] = engineWith(fourier::Storage::binary16);
    const auto [exact, floatPlan] = engineWith(fourier::Storage::float32);
    ASSERT_EQ(plan.spectrum.padded, floatPlan.spectrum.padded);
    const auto picture = rounded->render(scene.camera, scene.image, scene.shading),
               truth = exact->render(scene.camera, scene.image, scene.shading);
    ASSERT_EQ(picture.samples.size(), truth.samples.size());
    const auto parts = rounded->parts();
    render::FrameSetup setup(plan.fieldOfView);
    const accuracy::CentralEnergies central =
        accuracy::centralEnergies(parts.spectra,
                                  setup.inputsFor(parts.spectra, parts.channelWeights, scene.camera,
                                                  scene.image, scene.shading),
                                  scene.camera);
    const auto channels = std::size_t(picture.channels);
    const double pixelMm2 = scene.camera.pixelMm * scene.camera.pixelMm;
    for (std::size_t c = 0; c < channels; ++c) {
        double error = 0.0, energy = 0.0;
        for (std::size_t n = c; n < truth.samples.size(); n += channels) {
            error += std::pow(double(picture.samples[n]) - double(truth.samples[n]), 2) * pixelMm2;
            energy += std::pow(double(truth.samples[n]), 2) * pixelMm2;
        }
        ASSERT_GT(error, 0.0);
        // Less than 1 % of the energy lies beyond the cells; a part of a picture is sampled at 24 x
        // 24 points, in which waves of up to 4 periods have their energies within 2 %.
        EXPECT_NEAR(central.image[c], energy, 0.03 * energy) << c;
        // The rounding of the other cells adds as much as their share of the energy, and has as
        // many signs: a quarter either way.
        EXPECT_GT(central.error[c], error / 1.25) << c;
        EXPECT_LT(central.error[c], error * 1.25) << c;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shadings, CentralRounding,
    testing::Values(Case{"plain", {}}, Case{"farAway", {}, 0.2}, Case{"cropped", {}, 1.0, true},
                    Case{"linearCue", cued(shading::CueKind::linear)},
                    Case{"sineCue", cued(shading::CueKind::sine)},
                    Case{"curve", cued(shading::CueKind::curve)},
                    Case{"lit", lit({}, {1.0, 1.0, 1.0})},
                    Case{"litInColor", lit({}, {1.0, 0.6, 0.2})},
                    Case{"cuedAndLit", lit(cued(shading::CueKind::linear), {1.0, 1.0, 1.0})}),
    [](const auto &tested) { return std::string(tested.param.name); });

// Float cells keep no rounding, so there is nothing to predict.
TEST(CentralRoundingOfFloats, IsZeroForFloatCells) {
    scene::Scene scene;
    const DensityField field = blob();
    scene.camera = scene::defaultCamera(field.values.lattice());
    scene.interpolation.storage = fourier::Storage::float32;
    const auto prepared = prepare::prepareEngine(scene, classify::ShownFields{{field}, {}}, {});
    const auto parts = prepared.engine->parts();
    render::FrameSetup setup(parts.fieldOfView);
    const accuracy::CentralEnergies central = accuracy::centralEnergies(
        parts.spectra,
        setup.inputsFor(parts.spectra, parts.channelWeights, scene.camera, scene.image, {}),
        scene.camera);
    EXPECT_EQ(central.image[0], 0.0);
    EXPECT_EQ(central.error[0], 0.0);
}

} // namespace
} // namespace pellucid
