// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/reference/direct_sum.h"
#include "core/reference/exact_engine.h"
#include "core/reference/shaded_field.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using classify::Color;
using classify::ShownFields;

classify::DensityField field(unsigned seed) {
    return test::noiseField(test::tiltedLattice({13, 11, 7}, {0.8, 1.1, 2.0}, 20.0), seed);
}

scene::Camera cameraFor(const ShownFields &fields) {
    scene::Camera camera = scene::defaultCamera(fields.channels.front().values.lattice());
    camera.orientation = scene::viewOrientation(scene::StandardView::left, {20, 10, 5});
    return camera;
}

// A wide roll-off: short tails, small periods, quick sums.
constexpr scene::ImageDefinition definition{scene::Reconstruction::cubic, 0.5};

// Floats of the picture leave 6e-8 of each pixel, the wide kernel 1e-10.
constexpr double rounding = 1e-7;

TEST(ExactEngine, MakesTheDirectSumInGreyAndInAColor) {
    for (const Color &color : {Color{}, Color{1.0, 0.5, 0.25}}) {
        const ShownFields fields{{field(1)}, {color}};
        const auto camera = cameraFor(fields);
        const auto truth =
            reference::directSumImage(fields.channels.front().values, camera, definition);
        picture::FrameTimes times;
        const auto image =
            reference::ExactEngine(fields, {}).render(camera, definition, {}, &times);
        EXPECT_GT(times.totalMs(), 0.0);
        ASSERT_EQ(image.channels, fields.isGrey() ? 1 : 3);
        std::vector<double> expected = truth;
        if (!fields.isGrey()) {
            expected.clear();
            for (const double value : truth)
                for (const double c : {color.red, color.green, color.blue})
                    expected.push_back(c * value);
        }
        EXPECT_LT(test::relativeL2(image.samples, expected), rounding);
    }
}

TEST(ExactEngine, MakesAnImageForEachChannel) {
    const ShownFields fields{{field(1), field(2), field(3)}, classify::primaries};
    const auto camera = cameraFor(fields);
    const auto image = reference::ExactEngine(fields, {}).render(camera, definition);
    ASSERT_EQ(image.channels, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> plane;
        for (std::size_t n = c; n < image.samples.size(); n += 3)
            plane.push_back(image.samples[n]);
        EXPECT_LT(test::relativeL2(plane, reference::directSumImage(fields.channels[c].values,
                                                                    camera, definition)),
                  rounding);
    }
}

// Preparing for a shading moves work ahead of time, but does not change the picture.
TEST(ExactEngine, ShadesWhateverItWasPreparedFor) {
    const ShownFields fields{{field(1)}, {}};
    const auto camera = cameraFor(fields);
    const shading::Shading lit{.ambient = 0.5, .lights = {{{1.0, 0.0, 0.5}, {1.0, 0.5, 0.0}}}};
    reference::ExactEngine forPlain(fields, {}), forLit(fields, lit);
    const auto shaded = forLit.render(camera, definition, lit);
    ASSERT_EQ(shaded.channels, 3);
    EXPECT_EQ(forPlain.render(camera, definition, lit).samples, shaded.samples);
    EXPECT_LT(
        test::relativeL2(shaded.samples, reference::shadedImage(fields, lit, camera, definition)),
        rounding);
    // The field to be shaded is on a larger lattice, hence has a larger period: other tails fold
    // back, by at most 1e-4.
    const auto plain = forPlain.render(camera, definition);
    EXPECT_LT(test::relativeL2(forLit.render(camera, definition).samples, plain.samples), 1e-4);
}

TEST(Reference, ThePeriodLeavesRoomForTheRollOffToFade) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1.0, 1.0, 1.0});
    const scene::Camera camera = scene::defaultCamera(lattice);
    for (const double rollOff : {0.01, 0.05, 0.5}) {
        const scene::ImageDefinition image{scene::Reconstruction::cubic, rollOff};
        const auto period = reference::periodOf(lattice, camera, image);
        // The margin is six times 4/F, but at most that for F = 1/64.
        const double margin = std::min(24.0 / rollOff, 24.0 * 64.0);
        EXPECT_GE(period.columns, 2.0 * lattice.radiusMm() + margin);
        EXPECT_EQ(period.columns, period.rows);
    }
}

} // namespace
} // namespace pellucid
