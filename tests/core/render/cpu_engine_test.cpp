// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <memory>

#include "core/phantom/ellipsoids.h"
#include "core/phantom/phantom.h"
#include "core/plan/render_plan.h"
#include "core/reference/direct_sum.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using scene::Reconstruction;
using scene::StandardView;

render::CpuEngine engineFor(const classify::DensityField &field, const scene::Scene &scene = {}) {
    const auto plan = plan::planRender(scene, field::summarise(field));
    return render::CpuEngine(std::make_shared<const fourier::Spectrum>(
                                 fourier::Spectrum::prepare(field.values, plan.spectrum)),
                             plan.fieldOfView);
}

scene::Camera cameraFor(const volume::Lattice &lattice, StandardView view,
                        scene::ViewAngles angles = {}) {
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(view, angles);
    return camera;
}

// The default quality promises a relative L2 error of at most 1.1e-3 against the exact image.
constexpr double promisedError = 1.1e-3;

struct AccuracyCase {
    const char *name;
    volume::GridSize size;
    glm::dvec3 spacingMm;
    double tiltDeg;
    Reconstruction reconstruction;
};

class Accuracy : public testing::TestWithParam<AccuracyCase> {};

// Noise up to the faces of the lattice is the worst field: its spectrum is flat and it has no
// margin.
TEST_P(Accuracy, NoiseThatFillsTheLatticeAgainstTheDirectSum) {
    const AccuracyCase &c = GetParam();
    const auto field = test::noiseField(test::tiltedLattice(c.size, c.spacingMm, c.tiltDeg));
    auto engine = engineFor(field);
    const scene::ImageDefinition image{c.reconstruction, 0.05};
    for (const auto &angles : {scene::ViewAngles{0, 0, 0}, {90, 0, 0}, {31, 17, 8}, {0, 90, 0}}) {
        const auto camera = cameraFor(field.values.lattice(), StandardView::front, angles);
        const auto truth = reference::directSumImage(field.values, camera, image);
        EXPECT_LT(test::relativeL2(engine.render(camera, image).samples, truth), promisedError)
            << "azimuth " << angles.azimuthDeg << " elevation " << angles.elevationDeg;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, Accuracy,
    testing::Values(
        AccuracyCase{"isotropic", {24, 24, 24}, {1, 1, 1}, 0, Reconstruction::cubic},
        AccuracyCase{"isotropicLinear", {24, 24, 24}, {1, 1, 1}, 0, Reconstruction::linear},
        AccuracyCase{
            "isotropicBandLimited", {24, 24, 24}, {1, 1, 1}, 0, Reconstruction::bandLimited},
        AccuracyCase{"thickSlices", {26, 22, 7}, {0.8, 0.8, 5}, 0, Reconstruction::cubic},
        AccuracyCase{"thickSlicesLinear", {26, 22, 7}, {0.8, 0.8, 5}, 0, Reconstruction::linear},
        AccuracyCase{
            "thickSlicesBandLimited", {26, 22, 7}, {0.8, 0.8, 5}, 0, Reconstruction::bandLimited},
        AccuracyCase{"isotropicSpline", {24, 24, 24}, {1, 1, 1}, 0, Reconstruction::spline},
        AccuracyCase{"thickSlicesSpline", {26, 22, 7}, {0.8, 0.8, 5}, 0, Reconstruction::spline},
        AccuracyCase{"tilted", {20, 22, 15}, {0.9, 0.9, 2}, 30, Reconstruction::cubic},
        AccuracyCase{"veryThick", {24, 24, 5}, {0.4, 0.4, 8}, 0, Reconstruction::cubic},
        AccuracyCase{"oddSizes", {19, 23, 17}, {1, 1.3, 0.7}, 0, Reconstruction::cubic},
        AccuracyCase{"oneSlice", {33, 31, 1}, {1, 1, 5}, 0, Reconstruction::cubic},
        AccuracyCase{"oneVoxel", {1, 1, 1}, {1, 1, 1}, 0, Reconstruction::cubic},
        AccuracyCase{"twoVoxels", {2, 1, 2}, {1, 1, 1}, 0, Reconstruction::cubic}),
    [](const auto &parameter) { return std::string(parameter.param.name); });

// The roll-off is part of the image's definition, whatever its width; a table with linear
// interpolation would miss the corners of a band limit.
TEST(CpuEngine, RollOffsFromNarrowToWhole) {
    const auto field = test::noiseField(test::tiltedLattice({22, 20, 9}, {1, 1, 2.5}, 12));
    auto engine = engineFor(field);
    const auto camera = cameraFor(field.values.lattice(), StandardView::front, {31, 17, 8});
    for (const auto reconstruction : {Reconstruction::cubic, Reconstruction::bandLimited})
        for (const double rollOff : {0.04, 0.3, 1.0}) {
            const scene::ImageDefinition image{reconstruction, rollOff};
            EXPECT_LT(test::relativeL2(engine.render(camera, image).samples,
                                       reference::directSumImage(field.values, camera, image)),
                      promisedError)
                << rollOff;
        }
}

TEST(CpuEngine, PhantomsAgainstTheExactReference) {
    for (const auto kind : {phantom::Kind::head, phantom::Kind::chest, phantom::Kind::metal,
                            phantom::Kind::cube, phantom::Kind::bars}) {
        const auto lattice =
            phantom::phantomLattice(kind, {.size = volume::GridSize{64, 60, 52}, .tiltRad = 0.2});
        const auto volume = phantom::makePhantom(kind, lattice);
        const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
        const reference::WideKernel wide(field.values, field.support);
        auto engine = engineFor(field);
        for (const auto &angles : {scene::ViewAngles{0, 0, 0}, {47, -20, 5}}) {
            const auto camera = cameraFor(lattice, StandardView::front, angles);
            EXPECT_LT(test::relativeL2(engine.render(camera, {}).samples, wide.image(camera, {})),
                      promisedError)
                << phantom::nameOf(kind) << " azimuth " << angles.azimuthDeg;
        }
    }
}

TEST(CpuEngine, EllipsoidsAgainstTheirAnalyticIntegrals) {
    const auto lattice = volume::Lattice::centred({96, 96, 96}, {1.0, 1.0, 1.0});
    const auto volume = phantom::makePhantom(phantom::Kind::ellipsoids, lattice);
    const auto field = classify::densityField(volume, {phantom::ellipsoidBackgroundHu, 2000.0});
    const auto bodies = phantom::smoothEllipsoids(phantom::inscribedRadiusMm(lattice));
    auto engine = engineFor(field);
    const auto camera = cameraFor(lattice, StandardView::front, {25, 35, 15});
    const auto image = engine.render(camera, {});
    const auto axes = camera.axes();
    std::vector<double> truth(image.samples.size());
    for (int r = 0; r < camera.height; ++r)
        for (int c = 0; c < camera.width; ++c) {
            const double u = (c - 0.5 * (camera.width - 1)), v = (0.5 * (camera.height - 1) - r);
            truth[std::size_t(r) * camera.width + c] =
                phantom::lineIntegral(bodies, u * axes[0] + v * axes[1], axes[2]) / 3000.0;
        }
    // The promised error plus 3e-4 for sampling and rounding to whole HU.
    EXPECT_LT(test::relativeL2(image.samples, truth), promisedError + 3e-4);
}

TEST(CpuEngine, ASmallerImageIsACropAndNeverWraps) {
    const auto field = test::noiseField(test::tiltedLattice({24, 20, 12}, {1, 1, 2}, 10));
    auto engine = engineFor(field);
    auto camera = cameraFor(field.values.lattice(), StandardView::front, {20, 10, 0});
    // A different slice grid folds the roll-off's tails elsewhere; a roll-off over the whole band
    // has hardly any.
    const scene::ImageDefinition image{Reconstruction::cubic, 1.0};
    const auto whole = engine.render(camera, image);
    auto part = camera;
    part.width = camera.width - 24;
    part.height = camera.height - 30;
    const auto crop = engine.render(part, image);
    std::vector<float> expected;
    for (int r = 0; r < part.height; ++r)
        for (int c = 0; c < part.width; ++c)
            expected.push_back(whole.samples[std::size_t(r + 15) * camera.width + c + 12]);
    // Both images have aliasing within the plan's error, here relative to the crop's own norm.
    EXPECT_LT(test::relativeL2(crop.samples, expected), promisedError);
}

TEST(CpuEngine, PanMovesTheImage) {
    const auto field = test::noiseField(volume::Lattice::centred({20, 20, 20}, {1, 1, 1}));
    auto engine = engineFor(field);
    auto camera = cameraFor(field.values.lattice(), StandardView::left);
    const auto before = engine.render(camera, {});
    camera.panMm = {3.0, -2.0}; // the view moves right and down, the picture left and up
    const auto after = engine.render(camera, {});
    std::vector<float> a, b;
    for (int r = 4; r < camera.height - 4; ++r)
        for (int c = 4; c < camera.width - 4; ++c) {
            a.push_back(after.samples[std::size_t(r) * camera.width + c]);
            b.push_back(before.samples[std::size_t(r + 2) * camera.width + c + 3]);
        }
    // Two slice grids, each with its own aliasing.
    EXPECT_LT(test::relativeL2(a, b), promisedError);
}

TEST(CpuEngine, AnEmptyFieldGivesAnEmptyImage) {
    const auto lattice = volume::Lattice::centred({16, 16, 16}, {1, 1, 1});
    const volume::Volume air(lattice, std::vector<std::int16_t>(4096, -1000),
                             volume::ValueUnit::hounsfield);
    const auto field = classify::densityField(air, classify::defaultFieldWindow(air));
    auto engine = engineFor(field);
    for (const float p : engine.render(cameraFor(lattice, StandardView::front), {}).samples)
        EXPECT_EQ(p, 0.0F);
}

TEST(CpuEngine, AnImageWiderThanThePeriodStaysEmptyOutside) {
    const auto field = test::noiseField(volume::Lattice::centred({12, 12, 12}, {1, 1, 1}));
    auto engine = engineFor(field);
    auto camera = cameraFor(field.values.lattice(), StandardView::front);
    camera.width = 400;
    camera.height = 10;
    const auto image = engine.render(camera, {});
    float inside = 0.0F, outside = 0.0F;
    for (int c = 0; c < camera.width; ++c) {
        const float p = std::abs(image.samples[5 * std::size_t(camera.width) + c]);
        (std::abs(c - 200) < 8 ? inside : outside) =
            std::max(std::abs(c - 200) < 8 ? inside : outside, p);
    }
    // Only the interpolation's ringing next to the edge remains outside, 0.27 of a noise step for
    // the cubic spline.
    EXPECT_LT(outside, 0.2F * inside);
    EXPECT_LT(std::abs(image.samples[5 * std::size_t(camera.width) + 60]), 2e-3F * inside);
    EXPECT_LT(std::abs(image.samples[5 * std::size_t(camera.width) + 340]), 2e-3F * inside);
}

// Amplified detail is one more factor of the slice: within the stated error of the direct sum,
// which is within the tolerance, for small and large filters, pixels and parts of a picture.
TEST(CpuEngine, AmplifiedDetailKeepsTheTolerance) {
    const auto noise = test::noiseField(test::tiltedLattice({24, 22, 20}, {1.0, 1.0, 2.0}, 10.0));
    const auto ellipsoids = classify::densityField(
        phantom::makePhantom(phantom::Kind::ellipsoids,
                             volume::Lattice::centred({30, 30, 30}, {1, 1, 1})),
        {-900, 2000});
    for (const classify::DensityField *field : {&noise, &ellipsoids})
        for (const auto &[detail, detailMm] :
             {std::pair(0.5, 2.0), {2.0, 0.5}, {4.0, 3.0}, {4.0, 12.0}})
            for (const double tolerance : {1e-2, 1.1e-3, 2e-4}) {
                scene::Scene scene;
                scene.tolerance = tolerance;
                scene.image.detail = detail;
                scene.image.detailMm = detailMm;
                scene.camera = cameraFor(field->values.lattice(), StandardView::front, {31, 17, 8});
                scene.camera.width = scene.camera.height = 26;
                scene.camera.panMm = {3.0, -2.0};
                const auto plan = plan::planRender(scene, field::summarise(*field));
                render::CpuEngine engine(
                    std::make_shared<const fourier::Spectrum>(
                        fourier::Spectrum::prepare(field->values, plan.spectrum)),
                    plan.fieldOfView);
                const auto truth =
                    reference::directSumImage(field->values, scene.camera, scene.image);
                const double error =
                    test::relativeL2(engine.render(scene.camera, scene.image).samples, truth);
                EXPECT_LE(error, plan.predictedError) << detail << " " << detailMm;
                EXPECT_LE(plan.predictedError, tolerance) << detail << " " << detailMm;
            }
}

// The definition by itself: the filtered picture of a sharp point is the plain one plus A times its
// difference from the smoothed one, whose sum is the same.
TEST(CpuEngine, AmplifiedDetailKeepsTheMean) {
    const auto field = classify::densityField(
        phantom::makePhantom(phantom::Kind::ellipsoids,
                             volume::Lattice::centred({30, 30, 30}, {1, 1, 1})),
        {-900, 2000});
    auto engine = engineFor(field);
    scene::Camera camera = cameraFor(field.values.lattice(), StandardView::front);
    camera.width = camera.height = 128; // with room around
    const scene::ImageDefinition plain, sharp{.detail = 2.0, .detailMm = 2.0};
    const auto before = engine.render(camera, plain).samples,
               after = engine.render(camera, sharp).samples;
    double sumBefore = 0.0, sumAfter = 0.0;
    for (std::size_t n = 0; n < before.size(); ++n) {
        sumBefore += double(before[n]);
        sumAfter += double(after[n]);
    }
    EXPECT_NEAR(sumAfter / sumBefore, 1.0, 2e-3);
    EXPECT_GT(test::relativeL2(after, std::vector<double>(before.begin(), before.end())), 0.02);
}

} // namespace
} // namespace pellucid
