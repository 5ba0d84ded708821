// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/accuracy/view_error.h"
#include "core/plan/render_plan.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

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
    const auto plan = plan::planRender(sceneFor(lattice), plan::summarise(field));
    EXPECT_GE(plan.spectrum.padded.i, 27); // 1.25 times 21
    EXPECT_LE(plan.spectrum.padded.i, 42); // twice 21
    EXPECT_EQ(plan.spectrum.padded.j, 16); // the minimum
    EXPECT_EQ(plan.spectrum.padded.k, 16);
}

TEST(RenderPlan, TheSliceGridHoldsEveryDirection) {
    const auto lattice = volume::Lattice::centred({100, 100, 100}, {1, 1, 1});
    const auto field = test::noiseField(lattice);
    auto scene = sceneFor(lattice);
    const auto plan = plan::planRender(scene, plan::summarise(field));
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
    const auto summary = plan::summarise(test::noiseField(lattice));
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
    const auto summary = plan::summarise(test::noiseField(lattice));
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

// The framing of a picture: pixel size in shortest steps, side in pixels (0: the default), pan in
// pixels.
struct Framing {
    double pixel;
    int side;
    double pan;
};

// The plan's prediction bounds uncropped pictures from any direction; the two views here are not
// the worst ones. Each picture also has a prediction of its own, crops included, whose aliased
// tails come from the whole projection. It is at most four and a half times too high.
TEST(RenderPlan, PredictsTheMeasuredErrorOfEveryFraming) {
    for (const auto size : {volume::GridSize{32, 32, 32}, {40, 24, 12}})
        for (const Framing &framing :
             {Framing{1, 0, 0}, {1, 12, 0}, {1, 12, 9}, {1, 12, -9}, {4, 0, 0}, {0.5, 0, 0}}) {
            const auto lattice = test::tiltedLattice(size, {1, 1, 2}, 10);
            const auto field = test::noiseField(lattice);
            auto scene = sceneFor(lattice);
            scene.camera.pixelMm *= framing.pixel;
            const int whole = int(std::ceil(scene.camera.width / framing.pixel / 2.0)) * 2;
            scene.camera.width = scene.camera.height = framing.side > 0 ? framing.side : whole;
            scene.camera.panMm = {framing.pan, -0.5 * framing.pan};
            const auto summary = plan::summarise(field);
            const auto plan = plan::planRender(scene, summary);
            const accuracy::ViewErrorModel model(plan, {&summary, 1});
            render::CpuEngine engine(std::make_shared<const fourier::Spectrum>(
                                         fourier::Spectrum::prepare(field.values, plan.spectrum)),
                                     plan.fieldOfView);
            const reference::WideKernel wide(field.values, field.support);
            double measured = 0.0;
            for (const double azimuth : {0.0, 40.0}) {
                scene.camera.orientation =
                    scene::viewOrientation(scene::StandardView::front, {azimuth, 0.5 * azimuth, 0});
                const auto image = engine.render(scene.camera, scene.image);
                const double e =
                    test::relativeL2(image.samples, wide.image(scene.camera, scene.image));
                const double ofView =
                    model.errorOf(image, scene.camera, scene.image, engine.parts(), {}).relative;
                EXPECT_GE(ofView, e) << framing.pixel << ' ' << framing.side << ' ' << framing.pan;
                EXPECT_LE(ofView, 4.5 * e)
                    << framing.pixel << ' ' << framing.side << ' ' << framing.pan;
                measured = std::max(measured, e);
            }
            SCOPED_TRACE(testing::Message() << framing.pixel << " " << framing.side << " "
                                            << framing.pan << ": " << measured);
            if (framing.side == 0) {
                EXPECT_GT(plan.predictedError, measured);
            }
            // The plan knows how large a part is, but not what it shows.
            EXPECT_LT(plan.predictedError, (framing.side > 0 ? 30.0 : 20.0) * measured);
        }
}

} // namespace
} // namespace pellucid
