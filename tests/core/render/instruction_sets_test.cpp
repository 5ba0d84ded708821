// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include <hwy/targets.h>

#include "core/field/slab_products.h"
#include "core/plan/error_prediction.h"
#include "core/plan/sum_plan.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"
#include "core/render/frame_job.h"
#include "core/render/sum_engine.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

// Every kernel width and storage, on a tilted lattice with thick slices (whose spectrum is read
// beyond its period) and a camera between the axes.
class EveryWidth : public testing::TestWithParam<std::tuple<std::string, fourier::Storage>> {};

TEST_P(EveryWidth, IsWithinTheKernelsError) {
    const auto [name, storage] = GetParam();
    const auto lattice = test::tiltedLattice({24, 20, 12}, {1, 1.1, 2.5}, 15);
    const auto field = test::noiseField(lattice);
    const auto choice = fourier::kernelFromName(name);
    const auto kernel = fourier::makeKernel(choice, 2.0);
    const fourier::SpectrumLayout layout{
        {kernel, kernel, kernel}, field.support, {48, 40, 24}, storage};
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(scene::StandardView::left, {20, 30, 40});
    render::CpuEngine engine(std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(field.values, layout)));
    const auto exact = reference::WideKernel(field.values, field.support).image(camera, {});
    const double error = test::relativeL2(engine.render(camera, {}).samples, exact);
    // The tolerance adds up the kernel's error at padding 2, from the energy of its aliases with
    // all of them inside the image, rounding, and the roll-off's tails that fold back for any
    // field.
    const auto energy = field::energyMarginals(field.values, field.support);
    std::array<plan::AxisError, 3> axes;
    for (int d = 0; d < 3; ++d)
        axes[d] = plan::axisError(kernel, layout.padded[d], int(energy.axis[d].size()), 1.0);
    const double predicted = plan::predictRelativeError(axes, storage, energy, 1.0);
    const auto fieldOfView = plan::fieldOfViewOf(field.values.lattice(), field.support);
    EXPECT_LT(error, std::hypot(predicted, fieldOfView.aliasingLimit)) << predicted;

    // The same with a linear cue.
    const shading::DepthCue cue{shading::CueKind::linear, 1.0};
    for (int d = 0; d < 3; ++d)
        plan::addMomentError(axes[d], kernel,
                             {kernel, double(layout.padded[d]) / field.support.size()[d]},
                             layout.padded[d], field::evenSlabProducts(energy.axis[d]));
    const auto shaded = reference::shadedField(field, {.cue = cue}, camera.axes(), 0,
                                               shading::shadingScale(lattice));
    const auto exactCued = reference::WideKernel(shaded.values, shaded.support).image(camera, {});
    const double cuedError =
        test::relativeL2(engine.render(camera, {}, {.cue = cue}).samples, exactCued);
    const double predictedCued = plan::predictRelativeError(
        axes, storage, energy, 1.0,
        plan::cueWeight(cue, lattice, lattice.radiusMm(), layout, energy));
    EXPECT_LT(cuedError, std::hypot(predictedCued, fieldOfView.aliasingLimit)) << predictedCued;
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryWidth,
                         testing::Combine(testing::Values("nearest", "trilinear", "catmull-rom",
                                                          "b-spline", "hamming-sinc", "LS2", "LS3",
                                                          "LS4", "LS5", "LS6", "LS7", "ES5", "KB6"),
                                          testing::Values(fourier::Storage::binary16,
                                                          fourier::Storage::float32)));

// Every path of the vector code: one spectrum, moments, several slices, light of three colors. The
// spectrum also serves as the spectrum of its gradient.
const std::vector<shading::Shading> shadings{
    {},
    {.cue = {shading::CueKind::linear, 1.0}},
    {.cue = {shading::CueKind::sine, 1.0}, .lights = {{{1, 1, 1}}}},
    {.cue = {shading::CueKind::linear, 0.5},
     .lights = {{{1, 0, 0}, {1.0, 0.0, 0.0}}, {{0, 1, 1}, {0.0, 1.0, 0.5}}}}};

render::CpuEngine shadedEngine(const std::shared_ptr<const fourier::Spectrum> &spectrum,
                               int threads) {
    return {{{spectrum}, {spectrum}, shading::shadingScale(spectrum->lattice())},
            plan::fieldOfViewOf(spectrum->lattice(), spectrum->layout().box),
            threads};
}

// Calls `work` with each instruction set of this processor, the best first.
void withEachSet(const std::function<void(const std::string &set)> &work) {
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        work(render::instructionSet());
        hwy::SetSupportedTargetsForTest(0);
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void expectAgreement(const std::function<picture::Samples()> &render, const std::string &what) {
    picture::Samples best;
    withEachSet([&](const std::string &set) {
        const auto image = render();
        if (best.empty())
            best = image;
        const float peak = *std::max_element(best.begin(), best.end());
        float most = 0.0F;
        for (std::size_t n = 0; n < best.size(); ++n)
            most = std::max(most, std::abs(best[n] - image[n]));
        EXPECT_LT(most, 2e-6F * peak) << what << " " << set;
    });
}

// CpuEngine promises that instruction sets agree within 2e-6 of the largest value. They add in
// different orders, and only some fuse multiplications and additions.
TEST(InstructionSets, AgreeWithinRounding) {
    const auto lattice = test::tiltedLattice({32, 30, 17}, {1, 1, 2}, 10);
    const auto field = test::noiseField(lattice);
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {25, 35, 45});
    for (const shading::Shading &shading : shadings)
        for (const char *name : {"LS4", "LS6"})
            for (const auto storage : {fourier::Storage::binary16, fourier::Storage::float32}) {
                const auto kernel = fourier::makeKernel(fourier::kernelFromName(name), 1.5);
                const auto spectrum =
                    std::make_shared<const fourier::Spectrum>(fourier::Spectrum::prepare(
                        field.values,
                        {{kernel, kernel, kernel}, field.support, {48, 48, 28}, storage}));
                expectAgreement(
                    [&] { return shadedEngine(spectrum, 0).render(camera, {}, shading).samples; },
                    name);
            }
}

TEST(InstructionSets, SumTheSameAlongAView) {
    const auto lattice = test::tiltedLattice({32, 30, 17}, {1, 1, 2}, 10);
    const classify::ShownFields fields{{test::noiseField(lattice)}, {}};
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    const auto plan =
        plan::planSums(scene, field::summarise(std::span(fields.channels)), {}).value();
    for (const auto view : {scene::StandardView::front, scene::StandardView::left}) {
        scene.camera.orientation = scene::viewOrientation(view, {25, 35, 45});
        expectAgreement(
            [&] { return render::SumEngine(fields, plan).render(scene.camera, {}).samples; },
            "sums");
    }
}

// Plans follow from these: they must not differ from machine to machine.
TEST(InstructionSets, GiveAFieldTheSameStatistics) {
    const auto lattice = volume::Lattice::centred({37, 30, 17}, {1, 1, 2});
    const auto volume =
        test::volumeOf(lattice, [](const glm::dvec3 &at) { return std::sin(at.x * at.y) + at.z; });
    const auto field = classify::densityField(volume, {-3.0, 2.5});
    std::optional<field::EnergyMarginals> best;
    withEachSet([&](const std::string &set) {
        const auto energy = field::energyMarginals(field.values, field.support);
        if (!best)
            best = energy;
        EXPECT_EQ(energy.axis, best->axis) << set;
        EXPECT_EQ(energy.massMm3, best->massMm3) << set;
        EXPECT_EQ(energy.spread->byDistance, best->spread->byDistance) << set;
        EXPECT_EQ(energy.spread->roughestView, best->spread->roughestView) << set;
        EXPECT_EQ(energy.spread->peakedness, best->spread->peakedness) << set;
    });
}

TEST(InstructionSets, FourThreadsGiveTheBitsOfOne) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const auto field = test::noiseField(lattice);
    const auto kernel = fourier::Kernel::leastAliasing(4, 1.5);
    const auto spectrum = std::make_shared<const fourier::Spectrum>(fourier::Spectrum::prepare(
        field.values, {{kernel, kernel, kernel}, field.support, {60, 60, 60}}));
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {25, 35, 45});
    for (const shading::Shading &shading : shadings) {
        const auto one = shadedEngine(spectrum, 1).render(camera, {}, shading).samples;
        EXPECT_EQ(shadedEngine(spectrum, 2).render(camera, {}, shading).samples, one);
        EXPECT_EQ(shadedEngine(spectrum, 4).render(camera, {}, shading).samples, one);
    }
}

} // namespace
} // namespace pellucid
