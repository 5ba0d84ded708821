// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "app/bench/adaptive_slice.h"
#include "app/bench/measure.h"

namespace pellucid {

namespace {

constexpr int size = 96;

class AdaptiveSlice : public testing::Test {
protected:
    AdaptiveSlice() {
        scene.camera = scene::defaultCamera(subject.field.values.lattice());
        scene.interpolation = {fourier::kernelFromName("ES3"), 1.25, fourier::Storage::float32};
        spectrum = std::make_unique<fourier::Spectrum>(fourier::Spectrum::prepare(
            subject.field.values,
            plan::planRender(scene, field::summarise(subject.field)).spectrum));
        slices = std::make_unique<bench::AdaptiveSlice>(*spectrum);
    }

    const bench::Subject subject =
        bench::phantomSubject("head", phantom::Kind::head, {.size = volume::GridSize{48, 48, 48}});
    scene::Scene scene;
    const std::vector<glm::dquat> views = bench::randomViews(4);
    std::unique_ptr<fourier::Spectrum> spectrum;
    std::unique_ptr<bench::AdaptiveSlice> slices;
};

// The corrected bound of Totsuka and Levoy's equation 16 holds for every slice, and a looser bound
// reads fewer cells.
TEST_F(AdaptiveSlice, StaysWithinItsBoundAndSavesCells) {
    for (const glm::dquat &view : views) {
        scene.camera.orientation = view;
        const auto exact = slices->extract(scene.camera, size, 0.0);
        EXPECT_EQ(exact.cellsRead, 27 * exact.frequencies);
        std::size_t before = exact.cellsRead;
        for (const double bound : {0.01, 0.1, 1.0}) {
            const auto saving = slices->extract(scene.camera, size, bound);
            EXPECT_LE(bench::relativeL2(saving, exact), bound);
            EXPECT_LE(saving.cellsRead, before);
            before = saving.cellsRead;
        }
        EXPECT_LT(before, exact.cellsRead / 2);
    }
}

// A slice stores one half only: every column but the first also stands for its mirror image.
TEST(SliceError, IsThatOfTheWholeSlice) {
    bench::AdaptiveSlice::Slice exact{.size = 4};
    exact.samples.assign(4 * 3, {});
    exact.samples[0] = 1.0F;
    exact.samples[4] = 1.0F; // the second column
    auto first = exact, second = exact;
    first.samples[0] += 0.5F;
    second.samples[4] += 0.5F;
    EXPECT_DOUBLE_EQ(bench::relativeL2(first, exact), std::sqrt(0.25 / 3.0));
    EXPECT_DOUBLE_EQ(bench::relativeL2(second, exact), std::sqrt(0.5 / 3.0));
}

// The search finds the loosest bound that keeps the measured error. For a small error it begins
// with bounds that skip no cells.
TEST_F(AdaptiveSlice, FindsTheBoundOfAMeasuredError) {
    for (const double error : {3e-3, 1e-2}) {
        const auto there = bench::compareFiltersAt(*slices, scene.camera, size, views, error);
        EXPECT_LE(there.relativeL2, error);
        EXPECT_LT(there.share(), 1.0);
        // The search ended with a bound 2 % larger, which exceeds the error.
        const auto beyond =
            bench::compareFilters(*slices, scene.camera, size, views, 1.02 * there.bound);
        EXPECT_GT(beyond.relativeL2, error);
    }
}

// The search also ends if the narrow filter alone keeps the error.
TEST_F(AdaptiveSlice, ReadsOneCellWhereThatIsGoodEnough) {
    const auto there = bench::compareFiltersAt(*slices, scene.camera, size, views, 2.0);
    EXPECT_DOUBLE_EQ(there.share(), 1.0 / 27.0);
}

TEST(MultiplyAdds, AreThoseOfRealsAndTwiceWithACue) {
    EXPECT_EQ(bench::multiplyAdds(27.0, false), 54.0);
    EXPECT_EQ(bench::multiplyAdds(27.0, true), 108.0);
}

} // namespace
} // namespace pellucid
