// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "core/plan/render_plan.h"
#include "core/prepare/measured_error.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"
#include "core/task/error.h"
#include "tests/support/fields.h"
#include "tests/support/search_seed.h"

namespace pellucid {

namespace {

scene::Scene sceneFor(const volume::Lattice &lattice) {
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    return scene;
}

TEST(RenderPlan, PadsTheSupportOnly) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    samples[0] = samples[20] = 1.0F; // 21 x 1 x 1 samples
    const volume::Volume values(lattice, samples, volume::ValueUnit::none);
    const auto field = classify::densityField(values, {0, 1});
    const auto plan = plan::planRender(sceneFor(lattice), field::summarise(field));
    EXPECT_GE(plan.spectrum.padded.i, 27); // 1.25 times 21
    EXPECT_LE(plan.spectrum.padded.i, 42); // twice 21
    EXPECT_EQ(plan.spectrum.padded.j, 16); // the minimum
    EXPECT_EQ(plan.spectrum.padded.k, 16);
}

TEST(RenderPlan, TheSliceGridHoldsEveryDirection) {
    const auto lattice = volume::Lattice::centred({100, 100, 100}, {1, 1, 1});
    const auto field = test::noiseField(lattice);
    auto scene = sceneFor(lattice);
    const auto plan = plan::planRender(scene, field::summarise(field));
    // The projection of a cube is up to sqrt(3) N wide. A slice needs half of it plus half the
    // image.
    const auto grid = plan::sliceGrid(scene.camera, plan.fieldOfView, lattice, scene.image);
    EXPECT_GE(grid.columns, 173);
    scene.camera.width = 40;
    const auto narrow = plan::sliceGrid(scene.camera, plan.fieldOfView, lattice, scene.image);
    EXPECT_LT(narrow.columns, grid.columns);
    EXPECT_GE(narrow.rows, grid.rows); // aliases weigh more in a crop
    EXPECT_GE(narrow.columns, 20 + 86);
}

TEST(RenderPlan, ReducesWhatExceedsTheBudgetAndRefusesTheImpossible) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    const auto scene = sceneFor(lattice);
    const auto plan = plan::planRender(scene, summary);
    EXPECT_LE(plan.predictedError, scene.tolerance);
    EXPECT_EQ(plan::planRender(scene, summary, {plan.bytes}).bytes, plan.bytes);
    const auto reduced = plan::planRender(scene, summary, {plan.bytes * 7 / 10});
    EXPECT_LE(reduced.bytes, plan.bytes * 7 / 10);
    try {
        plan::planRender(scene, summary, {plan.bytes / 10});
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::outOfMemory);
    }
}

TEST(RenderPlan, TighterTolerancesTakeMoreTapsAndThenFloatCells) {
    const auto lattice = volume::Lattice::centred({48, 48, 48}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    auto scene = sceneFor(lattice);
    scene.image.rollOff = 1.0; // negligible tails
    int width = 0;
    for (const double tolerance : {3e-2, 1e-2, 1e-3, 1e-4, 2e-5}) {
        scene.tolerance = tolerance;
        const auto plan = plan::planRender(scene, summary);
        EXPECT_LE(plan.predictedError, tolerance);
        EXPECT_GE(plan.spectrum.width(), width);
        width = plan.spectrum.width();
        EXPECT_EQ(plan.spectrum.storage,
                  tolerance > 3e-4 ? fourier::Storage::binary16 : fourier::Storage::float32);
    }
}

// One picture is soon rendered, so its spectrum is prepared with the least padding.
TEST(RenderPlan, AFewPicturesTakeLittlePreparation) {
    const auto lattice = volume::Lattice::centred({96, 96, 96}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    const auto scene = sceneFor(lattice);
    const auto planFor = [&](int pictures) {
        return plan::planRender(scene, {&summary, 1}, plan::Composition{.pictures = pictures});
    };
    const auto one = planFor(1), many = planFor(500);
    EXPECT_LT(one.spectrum.padded.count(), many.spectrum.padded.count());
    EXPECT_GT(one.spectrum.width(), many.spectrum.width());
    for (const auto &plan : {one, many})
        EXPECT_LE(plan.predictedError, scene.tolerance);
}

// Two fields of one channel may err alike; their images need not overlap.
TEST(RenderPlan, FieldsThatAddUpCostTheirErrorTimesTheRootOfTheirNumber) {
    const volume::Lattice lattice = volume::Lattice::centred({24, 24, 24}, {1, 1, 1});
    const std::vector<classify::DensityField> fields{test::noiseField(lattice, 1),
                                                     test::noiseField(lattice, 2)};
    const auto summaries = field::summarise(std::span(fields));
    auto scene = sceneFor(lattice);
    scene.tolerance = 0.1;
    scene.image.rollOff = 1.0; // negligible tails
    scene.interpolation = {fourier::kernelFromName("LS4"), 1.5, fourier::Storage::float32};
    const auto apart = plan::planRender(scene, summaries, {2, 1}),
               together = plan::planRender(scene, summaries, {2, 2});
    EXPECT_NEAR(together.predictedError, std::sqrt(2.0) * apart.predictedError,
                1e-3 * apart.predictedError);
}

TEST(RenderPlan, TakesHalfOfTheSquaredToleranceUnlessOneKernelReadsEverything) {
    const volume::Lattice lattice = volume::Lattice::centred({48, 48, 48}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        auto scene = sceneFor(lattice);
        scene.tolerance = tolerance;
        EXPECT_LE(plan::planRender(scene, summary).predictedError, std::sqrt(0.5) * tolerance);
        scene.interpolation.isUniform = true;
        EXPECT_LE(plan::planRender(scene, summary).predictedError, tolerance);
    }
}

TEST(RenderPlan, FramesChooseWidthsWhereThatSavesTime) {
    const volume::Lattice lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    auto scene = sceneFor(lattice);
    const auto isAdaptive = [&](int pictures) {
        plan::Composition composition;
        composition.pictures = pictures;
        return plan::planRender(scene, {&summary, 1}, composition).isAdaptive;
    };
    EXPECT_FALSE(isAdaptive(1));
    EXPECT_TRUE(isAdaptive(500));
    scene.camera.pixelMm *= 0.1; // most of the slice is beyond the samples' band
    scene.camera.width = 1000;
    scene.camera.height = 1100;
    EXPECT_TRUE(isAdaptive(1));
    scene.interpolation.isUniform = true;
    EXPECT_FALSE(isAdaptive(500));
}

TEST(RenderPlan, WithOneWidthHasTheErrorThatItHadBeforeOthersWereAllowed) {
    const volume::Lattice lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    const auto summary = field::summarise(test::noiseField(lattice));
    auto scene = sceneFor(lattice);
    for (const double detail : {0.0, 2.0}) {
        scene.image.detail = detail;
        const auto before = plan::planRender(scene, summary);
        auto plan = before;
        plan::adaptWidths(plan, scene, {&summary, 1});
        ASSERT_GT(plan.adaptiveError, 0.0);
        ASSERT_GT(plan.predictedError, before.predictedError);
        plan = plan::withOneWidth(plan);
        EXPECT_EQ(plan.adaptiveError, 0.0);
        EXPECT_NEAR(plan.predictedError, before.predictedError, 1e-12);
    }
}

TEST(RenderPlan, LeavesErrorForNarrowKernels) {
    const volume::Lattice lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const auto adaptiveErrorOf = [&](const classify::DensityField &field, double pixelMm) {
        auto scene = sceneFor(lattice);
        scene.camera.pixelMm = pixelMm;
        scene.camera.width = scene.camera.height = int(64 / pixelMm);
        scene.tolerance = 1e-2;
        scene.interpolation = {fourier::kernelFromName("LS5"), 2.0, fourier::Storage::float32};
        const auto summary = field::summarise(field);
        auto plan = plan::planRender(scene, summary);
        plan::adaptWidths(plan, scene, {&summary, 1});
        EXPECT_LE(plan.predictedError, scene.tolerance);
        return plan.adaptiveError;
    };
    std::mt19937 random(6);
    std::normal_distribution<float> normal; // without a mean, which would be smooth
    std::vector<float> white(lattice.size().count());
    for (float &sample : white)
        sample = normal(random);
    const classify::DensityField noise =
        classify::fieldOf(test::noiseField(lattice).values, std::move(white));
    EXPECT_GT(adaptiveErrorOf(noise, 1.0), 0.0);
    EXPECT_GT(adaptiveErrorOf(noise, 0.5), 0.0);
    std::vector<float> ball(lattice.size().count());
    for (int k = 0; k < 40; ++k)
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 40; ++i)
                ball[lattice.size().offsetOf(i, j, k)] = float(std::exp(
                    -0.02 * (std::pow(i - 20, 2) + std::pow(j - 20, 2) + std::pow(k - 20, 2))));
    const classify::DensityField smooth = classify::fieldOf(noise.values, std::move(ball));
    EXPECT_GT(adaptiveErrorOf(smooth, 1.0), 0.0);
}

// The framing of a picture: pixel size in shortest steps, side in pixels (0: the default), pan in
// pixels.
struct Framing {
    double pixel;
    int side;
    double pan;
};

scene::Scene sceneFor(const volume::Lattice &lattice, const Framing &framing) {
    auto scene = sceneFor(lattice);
    scene.camera.pixelMm *= framing.pixel;
    const int whole = int(std::ceil(scene.camera.width / framing.pixel / 2.0)) * 2;
    scene.camera.width = scene.camera.height = framing.side > 0 ? framing.side : whole;
    scene.camera.panMm = {framing.pan, -0.5 * framing.pan};
    return scene;
}

// The errors of pictures of one field under one plan. *Units*: relative L2.
struct Errors {
    double planned = 0.0;
    std::vector<double> measured;           ///< for each view
    std::vector<error::StatedError> stated; ///< the same, measured as the program does
};

Errors errorsOf(const classify::DensityField &field, scene::Scene scene,
                const std::vector<glm::dquat> &views) {
    const auto summary = field::summarise(field);
    const auto plan = plan::planRender(scene, summary);
    render::CpuEngine engine(std::make_shared<const fourier::Spectrum>(
                                 fourier::Spectrum::prepare(field.values, plan.spectrum)),
                             plan.fieldOfView);
    const reference::WideKernel wide(field.values, field.support);
    Errors errors{plan.predictedError, {}, {}};
    for (const glm::dquat &view : views) {
        scene.camera.orientation = view;
        const auto image = engine.render(scene.camera, scene.image);
        errors.measured.push_back(
            test::relativeL2(image.samples, wide.image(scene.camera, scene.image)));
        errors.stated.push_back(
            prepare::measuredError(engine, {{field}, {}}, scene.camera, scene.image));
    }
    return errors;
}

// A slab with a sharp, bright edge beside faint noise: a crop beside the edge is darkened by the
// filter, but its errors are not.
classify::DensityField edgeField(const volume::Lattice &lattice) {
    const classify::DensityField noise = test::noiseField(lattice);
    const volume::GridSize size = lattice.size();
    std::vector<float> samples;
    std::vector<float> row(std::size_t(size.i));
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j) {
            const float *const values = noise.values.row({0, j, k}, size.i, row.data());
            for (int i = 0; i < size.i; ++i)
                samples.push_back(i < size.i / 2 ? 1.0F : 0.02F * values[i]);
        }
    return classify::fieldOf(volume::Volume(lattice, std::move(samples), volume::ValueUnit::none));
}

// Amplified detail: the error stays below the one that is stated, for whole pictures and parts.
TEST(RenderPlan, PredictsTheErrorOfAmplifiedDetail) {
    std::vector<glm::dquat> views;
    for (const double azimuth : {0.0, 40.0, 90.0})
        views.push_back(
            scene::viewOrientation(scene::StandardView::front, {azimuth, 0.5 * azimuth, 0}));
    const auto lattice = test::tiltedLattice({28, 20, 10}, {1, 1, 2}, 10);
    for (const auto &field : {test::noiseField(lattice), edgeField(lattice)})
        for (const auto &[detail, detailMm] : {std::pair(4.0, 1.0), {2.0, 3.0}})
            for (const double tolerance : {1.1e-3})
                for (const Framing &framing : {Framing{1, 0, 0}, {1, 12, 9}, {1, 10, -9}}) {
                    scene::Scene scene = sceneFor(lattice, framing);
                    scene.image.detail = detail;
                    scene.image.detailMm = detailMm;
                    scene.tolerance = tolerance;
                    const Errors errors = errorsOf(field, scene, views);
                    for (std::size_t n = 0; n < views.size(); ++n) {
                        EXPECT_LE(errors.measured[n], 1.1 * errors.stated[n].high)
                            << detail << " " << detailMm << " mm, " << tolerance << ", side "
                            << framing.side << ", pan " << framing.pan << ", view " << n;
                        if (framing.side == 0)
                            EXPECT_LE(errors.measured[n], errors.planned);
                    }
                }
}

// The plan's prediction bounds uncropped pictures from any direction; the two views here are not
// the worst ones. Each picture, crops included, is also measured as the program does it.
TEST(RenderPlan, PredictsTheMeasuredErrorOfEveryFraming) {
    std::vector<glm::dquat> views;
    for (const double azimuth : {0.0, 40.0})
        views.push_back(
            scene::viewOrientation(scene::StandardView::front, {azimuth, 0.5 * azimuth, 0}));
    for (const auto size : {volume::GridSize{32, 32, 32}, {40, 24, 12}})
        for (const Framing &framing :
             {Framing{1, 0, 0}, {1, 12, 0}, {1, 12, 9}, {1, 12, -9}, {4, 0, 0}, {0.5, 0, 0}}) {
            const auto lattice = test::tiltedLattice(size, {1, 1, 2}, 10);
            const Errors errors =
                errorsOf(test::noiseField(lattice), sceneFor(lattice, framing), views);
            SCOPED_TRACE(testing::Message()
                         << framing.pixel << ' ' << framing.side << ' ' << framing.pan);
            for (std::size_t n = 0; n < views.size(); ++n) {
                EXPECT_GE(1.1 * errors.stated[n].high, errors.measured[n]);
                EXPECT_LE(errors.stated[n].low, errors.measured[n]);
            }
            const double measured =
                *std::max_element(errors.measured.begin(), errors.measured.end());
            if (framing.side == 0) {
                EXPECT_GT(errors.planned, measured);
            }
            // The plan knows how large a part is, but not what it shows.
            EXPECT_LT(errors.planned, (framing.side > 0 ? 30.0 : 20.0) * measured);
        }
}

// Fields, lattices and views that no margin was fitted to, whole and cropped: what is predicted is
// not below what is measured.
TEST(RenderPlan, PredictsTheMeasuredErrorOfFreshFields) {
    const std::uint64_t seed = test::searchSeed();
    std::mt19937 random{static_cast<std::mt19937::result_type>(seed)};
    std::uniform_int_distribution<int> samples(12, 36);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int round = 0; round < 4; ++round) {
        const volume::GridSize size{samples(random), samples(random), samples(random)};
        const auto lattice = test::tiltedLattice(size, {1.0, 1.0, 1.0 + 2.0 * uniform(random)},
                                                 20.0 * uniform(random));
        const auto field = test::noiseField(lattice, unsigned(random()));
        const std::vector<glm::dquat> views{test::randomOrientation(random)};
        for (const Framing &framing : {Framing{1, 0, 0}, {1, 12, 4.0 * uniform(random)}}) {
            SCOPED_TRACE(testing::Message()
                         << "seed " << seed << ", round " << round << ", side " << framing.side);
            const Errors errors = errorsOf(field, sceneFor(lattice, framing), views);
            EXPECT_GT(errors.measured.front(), 0.0);
            EXPECT_GE(1.1 * errors.stated.front().high, errors.measured.front());
            if (framing.side == 0) {
                EXPECT_GE(errors.planned, errors.measured.front());
            }
        }
    }
}

} // namespace
} // namespace pellucid
