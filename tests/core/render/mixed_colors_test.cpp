// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "tests/support/fields.h"
#include "tests/support/json_text.h"

// Pictures whose colors are mixed from two, so that they need two images.
namespace pellucid {

namespace {

using shading::CueKind;

const std::array<shading::Shading, 4> shadings{
    shading::Shading{}, shading::Shading{.cue = {CueKind::sine, 0.9}},
    shading::Shading{.cue = {CueKind::linear, 1.0}},
    shading::Shading{.ambient = 0.4, .lights = {{{1, 0.2, 0}}}}};

classify::ShownFields twoColors(unsigned seed) {
    const auto lattice = test::tiltedLattice({30, 26, 19}, {0.8, 1.0, 2.1}, 15.0);
    return {{test::noiseField(lattice, seed), test::noiseField(lattice, seed + 1)},
            {{{1.0, 0.4, 0.1}, {0.3, 0.6, 1.0}}}};
}

// The sizes of panes that are no multiple of the batches, and larger than the period.
const std::array<std::array<int, 2>, 3> sizes{{{40, 32}, {37, 21}, {301, 163}}};

TEST(MixedColors, AreWithinTheToleranceOfTheExactPicture) {
    for (const shading::Shading &shading : shadings)
        for (const auto &[width, height] : sizes) {
            const classify::ShownFields fields = twoColors(7);
            scene::Scene scene;
            scene.camera = scene::defaultCamera(fields.channels.front().values.lattice());
            scene.camera.orientation =
                scene::viewOrientation(scene::StandardView::left, {25.0, 12.0, 7.0});
            scene.camera.width = width;
            scene.camera.height = height;
            scene.shading = shading;
            const auto prepared = prepare::prepareEngine({scene, fields});
            EXPECT_EQ(prepared.engine->parts().spectra.fields.size(), shading.isLit() ? 3U : 2U);
            const auto picture = prepared.engine->render(scene.camera, scene.image, shading);
            ASSERT_EQ(picture.channels, 3);
            const auto exact = reference::shadedImage(fields, shading, scene.camera, scene.image);
            const double error = test::relativeL2(picture.samples, exact);
            EXPECT_LE(error, prepared.plan.predictedError)
                << width << " " << shading::jsonOf(shading).dump();
            EXPECT_LE(prepared.plan.predictedError, scene.tolerance);
            const auto stated = prepare::measuredError(*prepared.engine, fields, scene.camera,
                                                       scene.image, shading);
            EXPECT_LE(error, 1.1 * stated.high) << width << " " << shading::jsonOf(shading).dump();
            EXPECT_GE(error, stated.low) << width << " " << shading::jsonOf(shading).dump();
        }
}

// Equal fields far apart: their errors are in phase, while their images do not overlap.
TEST(MixedColors, KeepTheToleranceWhereErrorsAddUp) {
    const volume::Lattice lattice = volume::Lattice::centred({48, 20, 20}, {1.0, 1.0, 1.0});
    classify::ShownFields fields{{}, {{{1.0, 0.9, 0.8}, {1.0, 0.8, 0.9}}}};
    for (const int first : {2, 36}) {
        std::vector<float> samples(lattice.size().count(), 0.0F);
        for (int k = 5; k < 15; ++k)
            for (int j = 5; j < 15; ++j)
                for (int i = first; i < first + 10; ++i)
                    samples[lattice.size().offsetOf(i, j, k)] = 1.0F;
        fields.channels.push_back(classify::fieldOf(
            volume::Volume(lattice, std::vector<float>(samples), volume::ValueUnit::none),
            std::move(samples)));
    }
    for (const double tolerance : {1e-2, 1.1e-3, 1e-4}) {
        scene::Scene scene;
        scene.camera = scene::defaultCamera(lattice);
        scene.tolerance = tolerance;
        const auto prepared = prepare::prepareEngine({scene, fields});
        for (const auto view : {scene::StandardView::front, scene::StandardView::left}) {
            scene.camera.orientation = scene::viewOrientation(view);
            const auto picture = prepared.engine->render(scene.camera, scene.image);
            EXPECT_LE(test::relativeL2(picture.samples, reference::shadedImage(
                                                            fields, {}, scene.camera, scene.image)),
                      prepared.plan.predictedError)
                << tolerance;
        }
        EXPECT_LE(prepared.plan.predictedError, tolerance);
    }
}

} // namespace
} // namespace pellucid
