// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "core/prepare/prepared_engine.h"
#include "core/reference/wide_kernel.h"
#include "gpu/gpu_engine.h"
#include "tests/gpu/card.h"
#include "tests/support/fields.h"
#include "tests/support/fresh_seed.h"

namespace pellucid {

namespace {

class FetchPlan : public test::CardTest {};

plan::RenderPlan planFor(const classify::ShownFields &fields, const char *kernel,
                         double tolerance = 1.1e-3) {
    scene::Scene scene{.camera = scene::defaultCamera(fields.channels.front().values.lattice()),
                       .tolerance = tolerance};
    if (kernel != nullptr)
        scene.interpolation.kernel = fourier::kernelFromName(kernel);
    return prepare::prepareEngine(scene, fields, {}).plan;
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
    // With light the share of the rounded part is not known.
    EXPECT_EQ(gpu::planFetch(plan, 1e-2, {.ambient = 0.5}).fetch, gpu::Fetch::exact);
}

TEST_F(FetchPlan, KernelsWithNegativeTapsAreReadCellByCell) {
    const auto fields = noise();
    EXPECT_TRUE(std::isinf(planFor(fields, "catmull-rom").filterError));
    for (const char *kernel : {"catmull-rom", "hamming-sinc", "nearest"})
        EXPECT_EQ(gpu::planFetch(planFor(fields, kernel), 1.0).fetch, gpu::Fetch::exact) << kernel;
}

// Cells at random places are read as by a card whose filter has 8 bits, and in double. The
// prediction equals the difference.
TEST_F(FetchPlan, TheRoundingOfTheFilterIsPredicted) {
    // The mean is removed: only a few places near frequency 0 would see it.
    auto fields = noise();
    classify::DensityField &field = fields.channels.front();
    std::vector<float> samples;
    field.values.samples().visit([&](auto values) {
        for (const auto f : values)
            samples.push_back(float(f) - 0.5F);
    });
    field.values =
        volume::Volume(field.values.lattice(), std::move(samples), volume::ValueUnit::none);
    for (const char *name : {"LS2", "LS3", "LS4", "LS5", "ES6", "b-spline"}) {
        const auto plan = planFor(fields, name);
        fourier::SpectrumLayout layout = plan.spectrum;
        layout.storage = fourier::Storage::float32;
        const auto spectrum = fourier::Spectrum::prepare(fields.channels.front().values, layout);
        std::mt19937 random(12);
        std::uniform_real_distribution<double> uniform(-0.45, 0.45);
        const int width = layout.width();
        double added = 0.0, all = 0.0;
        for (int n = 0; n < 2000; ++n) {
            std::array<std::vector<double>, 3> exact, rounded;
            std::array<int, 3> first{};
            for (std::size_t d = 0; d < 3; ++d) {
                const double g = std::abs(uniform(random)) * layout.padded[int(d)];
                first[d] = int(std::ceil(g - 0.5 * width));
                for (int k = 0; k < width; ++k)
                    exact[d].push_back(layout.kernels[d].value(first[d] + k - g));
                rounded[d] = exact[d];
                for (std::size_t k = 0; k + 1 < exact[d].size(); k += 2) {
                    const double sum = exact[d][k] + exact[d][k + 1];
                    const double at = std::round(256.0 * exact[d][k + 1] / sum) / 256.0;
                    rounded[d][k] = sum * (1.0 - at);
                    rounded[d][k + 1] = sum * at;
                }
            }
            std::complex<double> is, should;
            for (std::size_t z = 0; z < exact[2].size(); ++z)
                for (std::size_t y = 0; y < exact[1].size(); ++y)
                    for (std::size_t x = 0; x < exact[0].size(); ++x) {
                        const auto cell =
                            spectrum.value(first[0] + int(x), first[1] + int(y), first[2] + int(z));
                        should += exact[0][x] * exact[1][y] * exact[2][z] * cell;
                        is += rounded[0][x] * rounded[1][y] * rounded[2][z] * cell;
                    }
            added += std::norm(is - should);
            all += std::norm(should);
        }
        const double measured = std::sqrt(added / all);
        const double floor = std::sqrt(std::pow(gpu::planFetch(plan, 1.0).predictedError, 2) -
                                       std::pow(plan.predictedError, 2));
        // 2000 places scatter by two percent, the binned energy by one.
        EXPECT_NEAR(measured, floor, 0.06 * floor) << name;
    }
}

// Energy at the faces, where neighbouring cells differ most, costs more than in the middle.
TEST_F(FetchPlan, TheRoundingDependsOnWhereTheEnergyIs) {
    std::vector<double> middle(40, 0.0), faces(40, 0.0);
    middle[20] = 1.0;
    faces[0] = faces[39] = 0.5;
    const auto kernel = fourier::makeKernel(fourier::kernelFromName("LS4"), 1.5);
    EXPECT_GT(plan::filterError(kernel, 60, faces), 100.0 * plan::filterError(kernel, 60, middle));
}

// With filtered fetches the error of a view is at most 1.25 times the prediction for the mean of
// all views.
void expectKeepsPrediction(const std::shared_ptr<gpu::FramePasses> &card,
                           const classify::ShownFields &fields, const char *kernel,
                           const glm::dquat &view) {
    SCOPED_TRACE(kernel);
    const classify::DensityField &field = fields.channels.front();
    scene::Scene scene{.camera = scene::defaultCamera(field.values.lattice())};
    scene.interpolation.kernel = fourier::kernelFromName(kernel);
    scene.interpolation.storage = fourier::Storage::float32;
    const auto prepared = prepare::prepareEngine(scene, fields, {});
    const auto plan = gpu::planFetch(prepared.plan, 1.0);
    ASSERT_EQ(plan.fetch, gpu::Fetch::trilinear);
    const auto exact = gpu::copyToCard(card, *prepared.engine);
    const auto filtered = gpu::copyToCard(card, *prepared.engine, plan.fetch);
    scene.camera.orientation = view;
    const auto truth =
        reference::WideKernel(field.values, field.support).image(scene.camera, scene.image);
    const auto image = filtered->render(scene.camera, scene.image).samples;
    const double floor = std::sqrt(plan.predictedError * plan.predictedError -
                                   prepared.plan.predictedError * prepared.plan.predictedError);
    const double added = test::relativeL2(image, exact->render(scene.camera, scene.image).samples);
    EXPECT_LE(test::relativeL2(image, truth), 1.25 * plan.predictedError);
    EXPECT_LE(added, 1.25 * floor);
}

TEST_F(FetchPlan, FilteredFetchesKeepWhatIsPredicted) {
    const auto fields = noise();
    for (const char *kernel : {"trilinear", "LS2", "LS3", "LS4", "ES5", "b-spline", "KB6"}) {
        std::mt19937 random(4);
        expectKeepsPrediction(card, fields, kernel, test::randomOrientation(random));
    }
}

// The factor 1.25 was not fitted to this field and view.
TEST_F(FetchPlan, FilteredFetchesOfAFreshFieldKeepWhatIsPredicted) {
    std::mt19937 random{static_cast<std::mt19937::result_type>(test::freshSeed())};
    const classify::ShownFields fields{
        {test::noiseField(test::tiltedLattice({36, 30, 21}, {0.8, 1.0, 2.1}, 20.0),
                          unsigned(random()))},
        {}};
    expectKeepsPrediction(card, fields, "LS4", test::randomOrientation(random));
}

} // namespace
} // namespace pellucid
