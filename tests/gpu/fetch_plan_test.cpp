// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "core/reference/wide_kernel.h"
#include "core/render/prepared_engine.h"
#include "gpu/gpu_engine.h"
#include "tests/gpu/card.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

class FetchPlan : public test::CardTest {};

render::RenderPlan planFor(const classify::ShownFields &fields, const char *kernel,
                           double tolerance = 1.1e-3) {
    render::Scene scene{.camera = render::defaultCamera(fields.channels.front().values.lattice()),
                        .tolerance = tolerance};
    if (kernel != nullptr)
        scene.interpolation.kernel = fourier::kernelFromName(kernel);
    return render::prepareEngine(scene, fields, {}).plan;
}

classify::ShownFields noise() {
    return {{test::noiseField(test::tiltedLattice({36, 30, 21}, {0.8, 1.0, 2.1}, 20.0))}, {}};
}

TEST_F(FetchPlan, FiltersWhereTheToleranceHasRoom) {
    const auto fields = noise();
    const auto plan = planFor(fields, "LS4");
    EXPECT_EQ(gpu::planFetch(plan, 1e-2).fetch, gpu::Fetch::trilinear);
    EXPECT_GT(gpu::planFetch(plan, 1e-2).predictedError, plan.predictedError);
    EXPECT_EQ(gpu::planFetch(plan, plan.predictedError).fetch, gpu::Fetch::exact);
    EXPECT_EQ(gpu::planFetch(plan, plan.predictedError).predictedError, plan.predictedError);
    // A card with finer weights.
    EXPECT_EQ(gpu::planFetch(plan, 1.05 * plan.predictedError, 23).fetch, gpu::Fetch::trilinear);
}

TEST_F(FetchPlan, KernelsWithNegativeTapsAreReadCellByCell) {
    const auto fields = noise();
    for (const char *kernel : {"catmull-rom", "hamming-sinc", "nearest"})
        EXPECT_EQ(gpu::planFetch(planFor(fields, kernel), 1.0).fetch, gpu::Fetch::exact) << kernel;
}

// With filtered fetches the picture keeps what is predicted.
TEST_F(FetchPlan, FilteredFetchesKeepWhatIsPredicted) {
    const auto fields = noise();
    for (const char *kernel : {"trilinear", "LS2", "LS3", "LS4", "ES5", "b-spline", "KB6"}) {
        render::Scene scene{
            .camera = render::defaultCamera(fields.channels.front().values.lattice())};
        scene.interpolation.kernel = fourier::kernelFromName(kernel);
        scene.interpolation.storage = fourier::Storage::float32;
        const auto prepared = render::prepareEngine(scene, fields, {});
        const auto plan = gpu::planFetch(prepared.plan, 1.0);
        ASSERT_EQ(plan.fetch, gpu::Fetch::trilinear) << kernel;
        const auto exact = gpu::copyToCard(card, *prepared.engine);
        const auto filtered = gpu::copyToCard(card, *prepared.engine, plan.fetch);
        std::mt19937 random(4);
        scene.camera.orientation = test::randomOrientation(random);
        const auto truth = reference::WideKernel(fields.channels.front().values,
                                                 fields.channels.front().support)
                               .image(scene.camera, scene.image);
        const auto image = filtered->render(scene.camera, scene.image).samples;
        const double floor = std::sqrt(plan.predictedError * plan.predictedError -
                                       prepared.plan.predictedError * prepared.plan.predictedError);
        const double added =
            test::relativeL2(image, exact->render(scene.camera, scene.image).samples);
        RecordProperty(kernel, std::to_string(added) + " of " + std::to_string(floor));
        EXPECT_LE(test::relativeL2(image, truth), 1.25 * plan.predictedError) << kernel;
        EXPECT_LE(added, 1.25 * floor) << kernel;
    }
}

} // namespace
} // namespace pellucid
