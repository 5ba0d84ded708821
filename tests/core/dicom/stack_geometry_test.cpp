// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/dicom/reasons.h"
#include "tests/core/dicom/series_files.h"

namespace pellucid {

namespace {

using test::evenDepths;
using test::group;
using test::stack;

TEST(GroupSeries, OrderComesFromPositionsNotFromNames) {
    const auto entries = group(stack({10, 0, 5, 15}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].frames[0].path, "f1");
    EXPECT_EQ(entries[0].frames[3].path, "f3");
    EXPECT_NEAR(entries[0].geometry.lattice.sliceDistanceMm(), 5.0, 1e-12);
    EXPECT_TRUE(entries[0].notes.warnings.empty());
}

TEST(GroupSeries, UnevenStacksAreResampledToTheGridOfTheirLongestRun) {
    const auto entries = group(stack({0, 4, 8, 9, 16, 23}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_TRUE(entries[0].placed);
    EXPECT_NEAR(entries[0].geometry.lattice.sliceDistanceMm(), 4.0, 1e-12);
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 7); // 0, 4, ... 24: the last slice is inside
    ASSERT_EQ(entries[0].notes.warnings.size(), 1U);
    EXPECT_EQ(entries[0].notes.warnings[0].english(),
              "uneven slice spacing, resampled to 4.000 mm; it changes at f2 (4 then 1 mm); "
              "f3 (1 then 7 mm)");
}

double rounded(double value, double to) {
    return std::round(value / to) * to;
}

// The number of lattice slices that are scanned frames, not interpolated.
int framesKept(const dicom::VolumeEntry &entry) {
    const std::vector<double> &at = entry.geometry.frameOffsetsMm;
    if (at.empty())
        return int(entry.frames.size());
    const double step = entry.geometry.lattice.sliceDistanceMm();
    return int(std::count_if(at.begin(), at.end(), [&](double mm) {
        return std::abs(mm / step - std::round(mm / step)) < 1e-9;
    }));
}

// An odd gap at either end leaves all other slices as they are.
TEST(GroupSeries, AnOddGapAtAnEndKeepsTheOtherSlices) {
    for (const double odd : {0.7, 1.4, 2.3}) {
        std::vector<double> depths = evenDepths(91, 1.0);
        depths.insert(depths.begin(), -odd);
        const auto low = group(stack(depths));
        ASSERT_EQ(low.size(), 1U) << odd;
        EXPECT_EQ(framesKept(low[0]), 91) << odd;
        EXPECT_EQ(low[0].geometry.lattice.size().k, 91 + int(std::ceil(odd))) << odd;
        EXPECT_NEAR(low[0].geometry.lattice.origin().mm.z, -std::ceil(odd), 1e-9) << odd;

        depths = evenDepths(91, 1.0);
        depths.push_back(90.0 + odd);
        const auto high = group(stack(depths));
        ASSERT_EQ(high.size(), 1U) << odd;
        EXPECT_EQ(framesKept(high[0]), 91) << odd;
        EXPECT_EQ(high[0].geometry.lattice.size().k, 91 + int(std::ceil(odd))) << odd;
    }
}

// Whatever the step, the digits that positions are written with, the length of the stack and where
// it begins: 0.09 mm off is even, up to 0.15 steps.
TEST(GroupSeries, PositionsThatAreRoundedAreEven) {
    for (const double step : {0.625, 0.7, 1.25, 1.33, 2.5, 3.27, 5.0})
        for (const double digit : {0.1, 0.01, 0.001})
            for (const int count : {3, 20, 114, 800})
                for (const double start : {0.0, -113.37}) {
                    std::vector<double> depths = evenDepths(count, step);
                    for (double &z : depths)
                        z = rounded(z + start, digit);
                    const auto entries = group(stack(depths));
                    ASSERT_EQ(entries.size(), 1U);
                    const auto &geometry = entries[0].geometry;
                    EXPECT_TRUE(geometry.frameOffsetsMm.empty()) << step << ' ' << digit;
                    EXPECT_EQ(geometry.lattice.size().k, count);
                    // A rounding error at an end turns the line by at most that over its length.
                    EXPECT_NEAR(geometry.lattice.sliceDistanceMm(), step, digit / (count - 1));
                    EXPECT_TRUE(entries[0].notes.warnings.empty());
                }
}

TEST(GroupSeries, MissingSlicesOfARoundedStackStayOnItsGrid) {
    std::vector<double> depths = evenDepths(120, 1.25);
    depths.erase(depths.begin() + 60);
    depths.erase(depths.begin() + 20);
    for (double &z : depths)
        z = rounded(z, 0.1);
    const auto entries = group(stack(depths));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 120);
    EXPECT_EQ(framesKept(entries[0]), 118);
    EXPECT_EQ(entries[0].notes.filled, (std::vector<volume::SliceRange>{{20, 20}, {60, 60}}));
    ASSERT_EQ(entries[0].notes.warnings.size(), 1U);
    EXPECT_TRUE(entries[0].notes.warnings[0].is(task::because::missingSlices))
        << entries[0].notes.warnings[0].english();
}

TEST(GroupSeries, AGapGivesEachRunAndTheFilledStack) {
    const auto entries = group(stack({0, 2, 4, 6, 11.5, 13.5}));
    ASSERT_EQ(entries.size(), 3U);
    EXPECT_EQ(dicom::labelText(entries[0].label), "slices 1 to 4, axial 1");
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 4);
    EXPECT_EQ(dicom::labelText(entries[1].label), "slices 5 to 6, axial 2");
    EXPECT_EQ(entries[0].notes.warnings.back().english(),
              "slices 1 to 4 of 6: a gap of 5.5 mm between f3 and f4");
    EXPECT_EQ(entries[2].notes.warnings.back().english(),
              "missing slices, interpolated: 5.5 mm between f3 and f4");
    EXPECT_TRUE(entries[2].fillsHoles);
    EXPECT_EQ(entries[2].frames.size(), 6U);
    EXPECT_EQ(entries[2].geometry.lattice.size().k, 8); // 0 to 14
    EXPECT_EQ(entries[2].notes.filled, (std::vector<volume::SliceRange>{{4, 5}}));
    for (const auto &entry : entries) {
        EXPECT_TRUE(entry.placed);
        std::string all;
        for (const task::Reason &warning : entry.notes.warnings)
            all += warning.english();
        EXPECT_NE(all.find("f3"), std::string::npos) << all;
        EXPECT_NE(all.find("f4"), std::string::npos) << all;
    }
    EXPECT_EQ(group(stack({0, 2, 4, 6, 10.9, 12.9})).size(), 1U); // 2.45 gaps
    // A survey is not filled from end to end.
    for (const auto &entry : group(stack({0, 202.5, 203.75, 205})))
        EXPECT_FALSE(entry.fillsHoles);
}

// Phases have the same hole: each run is one stack.
TEST(GroupSeries, RunsOfPhasesAreTheirPhases) {
    auto files = stack({0, 2, 4, 10, 12, 14, 0, 2, 4, 10, 12, 14});
    for (int n = 0; n < 12; ++n)
        files[n].header.frames[0].dimensions[0x00200100] = n < 6 ? "1" : "2";
    std::vector<std::string> labels;
    for (const auto &entry : group(files))
        labels.push_back(dicom::labelText(entry.label));
    EXPECT_EQ(labels, (std::vector<std::string>{"temporal position 1, slices 1 to 3, axial 1",
                                                "temporal position 2, slices 1 to 3, axial 1",
                                                "temporal position 1, slices 4 to 6, axial 2",
                                                "temporal position 2, slices 4 to 6, axial 2",
                                                "temporal position 1, gaps filled, axial 3",
                                                "temporal position 2, gaps filled, axial 3"}));
}

TEST(GroupSeries, StraySlicesDoNotMultiplyTheStack) {
    // Two images are a hundredth of a slice away from others: that gap is not the spacing.
    const auto entries = group(stack({0, 0.05, 0.1, 5, 10, 15, 20, 25}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 6);
    EXPECT_FALSE(entries[0].notes.warnings.empty());
    // No grid holds both a regular stack and a slice far away from it.
    const auto far = group(stack({0, 100, 100.5, 101}));
    EXPECT_FALSE(far.empty());
    for (const auto &entry : far)
        EXPECT_FALSE(entry.fillsHoles);
}

TEST(GroupSeries, GapsThatCreepAreNotEven) {
    std::vector<double> depths{0};
    for (int n = 0; n < 100; ++n)
        depths.push_back(depths.back() + (n < 50 ? 1.0 : 1.02));
    const auto entries = group(stack(depths));
    EXPECT_FALSE(entries[0].geometry.frameOffsetsMm.empty()); // 0.15 mm off in the middle
}

TEST(GroupSeries, ASliceBesideTheLineIsRefused) {
    auto files = stack({0, 2, 4, 6});
    files[2].header.frames[0].positionMm->x = 3.0;
    const auto entries = group(files);
    EXPECT_FALSE(entries[0].placed);
    ASSERT_TRUE(entries[0].notPlacedReason);
    EXPECT_NE(entries[0].notPlacedReason->english().find("f2"), std::string::npos);
    files[2].header.frames[0].positionMm->x = 0.19; // two pixels of 1 mm, fitted: 0.13 mm
    EXPECT_TRUE(group(files)[0].placed);
}

// Two computers round axes and pixel spacings differently.
TEST(GroupSeries, AxesAndSpacingsThatJitterAreOneStack) {
    const auto jittered = [](double axes, double spacing) {
        auto files = stack(evenDepths(40, 2.0));
        for (std::size_t n = 0; n < files.size(); ++n) {
            dicom::FrameHeader &frame = files[n].header.frames[0];
            const double turn = axes * std::sin(1.7 * double(n));
            frame.rowAxis = glm::normalize(glm::dvec3(1, turn, -turn));
            frame.columnAxis = glm::normalize(glm::cross(glm::dvec3(turn, 0, 1), *frame.rowAxis));
            frame.spacingMm = glm::dvec2(3.2 * (1.0 + spacing * std::cos(2.3 * double(n))));
        }
        return group(files);
    };
    for (const auto &[axes, spacing, warnings] :
         {std::tuple(1e-4, 0.0, 0U), std::tuple(5e-4, 6e-5, 0U), std::tuple(0.0, 6e-5, 0U),
          std::tuple(9e-4, 0.0, 1U), std::tuple(0.0, 6e-4, 1U), std::tuple(0.0, 1.1e-3, 1U)}) {
        const auto entries = jittered(axes, spacing);
        ASSERT_EQ(entries.size(), 1U) << axes << ' ' << spacing;
        EXPECT_EQ(entries[0].geometry.lattice.size().k, 40);
        EXPECT_EQ(entries[0].notes.warnings.size(), warnings) << axes << ' ' << spacing;
        EXPECT_NEAR(entries[0].geometry.lattice.sliceNormal().z, 1.0, 1e-6);
    }
    EXPECT_GT(jittered(0.02, 0.0).size(), 1U);
    EXPECT_GT(jittered(0.0, 0.01).size(), 1U);
}

TEST(GroupSeries, WithoutPositionsThereAreImagesButNoVolume) {
    auto files = stack({0, 2});
    files[0].header.frames[0].positionMm.reset();
    files[1].header.frames[0].positionMm.reset();
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_FALSE(entries[0].placed);
    EXPECT_EQ(entries[0].frames.size(), 2U);
    EXPECT_EQ(entries[0].notPlacedReason, task::Reason(task::because::noPosition));
}

TEST(GroupSeries, AFlippedColumnAxisKeepsARightHandedLattice) {
    auto files = stack({0, 2, 4});
    for (auto &f : files)
        f.header.frames[0].columnAxis = glm::dvec3(0, -1, 0);
    const auto entries = group(files);
    const auto &lattice = entries[0].geometry.lattice;
    EXPECT_EQ(lattice.step(1), glm::dvec3(0, -1, 0));
    EXPECT_EQ(lattice.step(2), glm::dvec3(0, 0, -2)); // from the highest slice down
    EXPECT_EQ(entries[0].frames[0].path, "f2");
}

} // namespace
} // namespace pellucid
