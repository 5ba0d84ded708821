// SPDX-License-Identifier: GPL-3.0-or-later
// Short searches for a predicted error below the measured one; `pellucid-bench --suite search`
// searches for as long as you like.
#include <gtest/gtest.h>

#include <vector>

#include "app/bench/error_search.h"
#include "app/bench/error_sweep.h"
#include "core/phantom/phantom.h"
#include "core/plan/render_plan.h"
#include "core/reference/wide_kernel.h"
#include "core/render/cpu_engine.h"
#include "tests/support/fresh_seed.h"

namespace pellucid {

namespace {

void expectNoCounterexample(std::uint64_t seed, int trials) {
    const auto result =
        bench::searchCounterexample({.seed = seed, .seconds = 300, .trials = trials});
    EXPECT_LE(result.verdict.ratio(), 1.0)
        << "seed " << seed << ", " << bench::trialOf(result.worst, bench::PictureKind::whole).name
        << ": predicted " << result.verdict.predicted << ", measured " << result.verdict.measured;
    EXPECT_GT(result.verdict.ratio(), 0.0);
}

TEST(ErrorSearch, NoFieldAndViewExceedTheBound) {
    expectNoCounterexample(20261123, 28);
}

TEST(ErrorSearch, NoFreshFieldAndViewExceedTheBound) {
    expectNoCounterexample(test::freshSeed(), 8);
}

// The error predicted for a single picture is never below the measured error, and close to it.
TEST(ErrorSearch, TheErrorOfAPictureIsCloseToWhatIsMeasured) {
    const auto factors = bench::picturePredictionFactors(40, 20261123);
    EXPECT_GE(factors.front().factor, 1.0) << factors.front().name;
    // With so few pictures, one may be an almost empty part; the bench takes 300.
    EXPECT_LE(factors[factors.size() * 95 / 100].factor, 5.5);
    EXPECT_LT(factors[factors.size() / 2].factor, 2.5);
}

// Ten pictures are too few for quantiles: half of them must meet the limit for 95 %.
TEST(ErrorSearch, TheErrorOfAFreshPictureIsCloseToWhatIsMeasured) {
    const std::uint64_t seed = test::freshSeed();
    const auto factors = bench::picturePredictionFactors(10, seed);
    EXPECT_GE(factors.front().factor, 1.0) << "seed " << seed << ", " << factors.front().name;
    EXPECT_LE(factors[factors.size() / 2].factor, 5.5) << "seed " << seed;
}

// Three fields for each seed; the bench takes 200.
TEST(ErrorSweep, EveryToleranceIsKeptAndNoErrorIsHigherThanStated) {
    int pictures = 0;
    for (const std::uint64_t seed : {std::uint64_t(20261125), test::freshSeed()})
        bench::sweep(3, seed, [&](const bench::SweptPicture &picture) {
            ++pictures;
            EXPECT_LE(picture.measured, picture.stated) << "seed " << seed << ", " << picture.name;
            EXPECT_LE(picture.measured, picture.planned) << "seed " << seed << ", " << picture.name;
        });
    EXPECT_EQ(pictures, 2 * 3 * 5 * 6);
}

scene::Scene sceneFor(const volume::Lattice &lattice, const glm::dquat &view, double tolerance) {
    scene::Scene scene;
    scene.camera = scene::defaultCamera(lattice);
    scene.camera.orientation = view;
    scene.tolerance = tolerance;
    return scene;
}

bench::Verdict judged(const volume::Lattice &lattice, std::vector<float> samples,
                      const glm::dquat &view, double tolerance) {
    bench::Trial trial{
        "",
        classify::densityField(volume::Volume(lattice, std::move(samples), volume::ValueUnit::none),
                               {0.0, 1.0}),
        sceneFor(lattice, view, tolerance)};
    return bench::judge(trial);
}

// This field once exceeded its prediction: two bright samples in opposite corners, seen at 45
// degrees, where the aliases of two axes coincide.
TEST(ErrorSearch, TwoSamplesInOppositeCorners) {
    const auto lattice = volume::Lattice::centred({48, 48, 48}, {1, 1, 1});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    samples.front() = samples.back() = 1.0F;
    for (const double azimuth : {45.0, 135.0, 0.0})
        for (const double tolerance : {1e-2, 1.1e-3}) {
            const auto verdict = judged(
                lattice, samples,
                scene::viewOrientation(scene::StandardView::front, {azimuth, 0, 0}), tolerance);
            EXPECT_LE(verdict.predicted, tolerance) << azimuth;
            EXPECT_LE(verdict.measured, verdict.predicted) << azimuth << ' ' << tolerance;
            EXPECT_LE(verdict.measured, verdict.ofView) << azimuth << ' ' << tolerance;
        }
}

// Along an axis one moment kernel reads the whole depth. Its error was once missing from the
// picture's own prediction.
TEST(ErrorSearch, AFullLinearCueAlongAnAxis) {
    const auto volume = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{64, 64, 20}}));
    const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
    for (const auto view : {scene::StandardView::front, scene::StandardView::top})
        for (const double tolerance : {1.1e-3, 1e-4}) {
            bench::Trial trial{"", field,
                               sceneFor(volume.lattice(), scene::viewOrientation(view), tolerance)};
            trial.scene.shading.cue.kind = shading::CueKind::linear;
            trial.scene.shading.cue.strength = 1.0;
            const bench::Verdict verdict = bench::judge(trial);
            EXPECT_LE(verdict.measured, verdict.ofView) << tolerance;
            EXPECT_LE(verdict.ofView, 3.0 * verdict.measured) << tolerance;
        }
}

// Alternate samples along one or two axes also exceeded their prediction: their spectral lines lie
// in the roll-off, where the tails of all samples add up in phase. Finer pixels test the same in
// the lattice's own roll-off.
TEST(ErrorSearch, PatternsWhoseLinesLieInTheRollOff) {
    for (const double step : {1.02, 1.035})
        for (const bool inBoth : {false, true})
            for (const auto reconstruction :
                 {scene::Reconstruction::cubic, scene::Reconstruction::bandLimited}) {
                const auto lattice = volume::Lattice::centred({20, 20, 20}, {1.0, step, step});
                std::vector<float> samples;
                for (int k = 0; k < 20; ++k)
                    for (int j = 0; j < 20; ++j)
                        for (int i = 0; i < 20; ++i)
                            samples.push_back(j % 2 == 1 && (k % 2 == 1 || !inBoth) ? 1.0F : 0.0F);
                const bool isCubic = reconstruction == scene::Reconstruction::cubic;
                bench::Trial trial{
                    "",
                    classify::densityField(
                        volume::Volume(lattice, std::move(samples), volume::ValueUnit::none),
                        {0.0, 1.0}),
                    sceneFor(lattice, scene::viewOrientation(scene::StandardView::left), 1.1e-3)};
                trial.scene.image.reconstruction = reconstruction;
                if (!isCubic) {
                    trial.scene.camera.pixelMm *= 0.5;
                    trial.scene.camera.width *= 2;
                    trial.scene.camera.height *= 2;
                }
                for (const double rollOff : {0.05, 0.02}) {
                    trial.scene.image.rollOff = rollOff;
                    const auto verdict = bench::judge(trial);
                    EXPECT_LE(verdict.measured, verdict.predicted)
                        << step << ' ' << inBoth << ' ' << isCubic << ' ' << rollOff;
                    EXPECT_LE(verdict.measured, verdict.ofView)
                        << step << ' ' << inBoth << ' ' << isCubic << ' ' << rollOff;
                }
            }
}

// A picture of a few pixels shows faint samples beside a bright one. It does not tell which tails
// come from outside.
TEST(ErrorSearch, AFewPixelsBesideABrightSample) {
    const auto lattice = volume::Lattice::centred({33, 33, 33}, {1, 1, 1});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    const auto at = [&](int i) -> float & { return samples[std::size_t((16 * 33 + 16) * 33 + i)]; };
    at(16) = 1.0F;
    for (const float faint : {0.003F, 0.03F})
        for (const int side : {1, 2, 8}) {
            at(6) = at(26) = faint;
            bench::Trial trial{
                "",
                classify::densityField(volume::Volume(lattice, samples, volume::ValueUnit::none),
                                       {0.0, 1.0}),
                sceneFor(lattice, scene::viewOrientation(scene::StandardView::front), 1.1e-3)};
            trial.scene.camera.width = trial.scene.camera.height = side;
            trial.scene.camera.panMm = {10.0, 0.0};
            const auto verdict = bench::judge(trial);
            EXPECT_LE(verdict.measured, verdict.ofView) << faint << ' ' << side;
        }
}

// A thin oblique sheet off the centre, seen edge on, also exceeded its prediction: its whole
// picture is at the edge of the band.
TEST(ErrorSearch, AThinSheetSeenEdgeOn) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 1});
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 0.37, 0.21));
    std::vector<float> samples;
    for (int k = 0; k < 40; ++k)
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 40; ++i) {
                const double far =
                    glm::dot(lattice.patient(volume::VoxelIndex{i, j, k}).mm, normal) - 11.0;
                samples.push_back(float(std::exp(-far * far)));
            }
    const glm::dvec3 w = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1))),
                     u = glm::normalize(normal);
    const glm::dquat view = glm::quat_cast(glm::dmat3(u, glm::cross(w, u), w));
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        const auto verdict = judged(lattice, samples, view, tolerance);
        EXPECT_LE(verdict.measured, verdict.predicted) << tolerance;
        EXPECT_LE(verdict.measured, verdict.ofView) << tolerance;
    }
}

} // namespace
} // namespace pellucid
