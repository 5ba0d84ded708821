// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <ctime>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/dicom/group_series.h"

namespace pellucid {

namespace {

using dicom::InstanceHeader;
using dicom::SeriesFile;

// A file at a depth along z, 4 x 3 pixels of 1 mm.
SeriesFile file(const std::string &name, double z) {
    SeriesFile f{name, {}};
    f.header.rows = 3;
    f.header.columns = 4;
    f.header.sopInstanceUid = "1.2." + name;
    dicom::FrameHeader frame;
    frame.positionMm = glm::dvec3(0, 0, z);
    frame.rowAxis = glm::dvec3(1, 0, 0);
    frame.columnAxis = glm::dvec3(0, 1, 0);
    frame.spacingMm = glm::dvec2(1, 1);
    frame.sliceThicknessMm = 2.5;
    f.header.frames = {frame};
    return f;
}

std::vector<SeriesFile> stack(const std::vector<double> &depths) {
    std::vector<SeriesFile> files;
    for (const double z : depths)
        files.push_back(file("f" + std::to_string(files.size()), z));
    return files;
}

std::vector<dicom::VolumeEntry> group(const std::vector<SeriesFile> &files) {
    std::vector<dicom::Skipped> skipped;
    return dicom::groupSeries(files, skipped);
}

// A localizer: three stacks of one size and spacing, one of them twice at another angle.
TEST(GroupSeries, EveryVolumeOfASeriesHasALabelOfItsOwn) {
    std::vector<SeriesFile> files;
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const auto add = [&](const glm::dvec3 &row, const glm::dvec3 &column) {
        for (int n = 0; n < 3; ++n) {
            SeriesFile f = file("f" + std::to_string(files.size()), 0.0);
            f.header.frames[0].rowAxis = row;
            f.header.frames[0].columnAxis = column;
            f.header.frames[0].positionMm = 5.0 * n * glm::cross(row, column);
            files.push_back(f);
        }
    };
    add(x, y);
    add(x, -z);
    add(y, -z);
    add(glm::normalize(x + 0.2 * y), glm::normalize(y - 0.2 * x));
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 4U);
    EXPECT_EQ(entries[0].label, "axial 1");
    EXPECT_EQ(entries[1].label, "coronal");
    EXPECT_EQ(entries[2].label, "sagittal");
    EXPECT_EQ(entries[3].label, "axial 2");
}

// Phases of one stack share its name; a stack of another space is none of them.
TEST(GroupSeries, PhasesOfOneStackSayThatTheyAre) {
    auto files = stack({0, 2, 4, 0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 9; ++n) {
        files[n].header.frames[0].dimensions["temporal position"] = n < 3 ? "1" : "2";
        files[n].header.frameOfReferenceUid = n < 6 ? "1.2" : "1.3";
    }
    std::vector<std::string> labels;
    for (const dicom::VolumeEntry &entry : group(files))
        labels.push_back(entry.label);
    std::sort(labels.begin(), labels.end());
    EXPECT_EQ(labels, (std::vector<std::string>{"axial 2", "temporal position 1, axial 1",
                                                "temporal position 2, axial 1"}));
}

// Thousands of images at a handful of places, as of a long perfusion without any times.
TEST(GroupSeries, ManyImagesAtOnePlaceAreSetsInTheOrderOfTheirNumbers) {
    constexpr int places = 3;
    const auto seconds = [](int sets) {
        std::vector<SeriesFile> files;
        for (int n = 0; n < places * sets; ++n) {
            SeriesFile f = file("f", 2.0 * (n % places));
            f.header.instanceNumber = n;
            f.header.sopInstanceUid = std::to_string(n);
            files.push_back(f);
        }
        std::reverse(files.begin(), files.end());
        double fastest = 1e9;
        for (int round = 0; round < 3; ++round) {
            const std::clock_t start = std::clock(); // of this process, whatever runs beside it
            const auto entries = group(files);
            fastest = std::min(fastest, double(std::clock() - start));
            EXPECT_EQ(entries.size(), std::size_t(sets));
            EXPECT_EQ(entries.front().label, "set 1");
            EXPECT_EQ(entries.back().label, "set " + std::to_string(sets));
            for (const auto &entry : entries)
                EXPECT_EQ(entry.frames.size(), std::size_t(places));
        }
        return fastest;
    };
    // Sixteen times as many take 16 times as long, twice that beyond the caches; not 256 times.
    EXPECT_LT(seconds(8000), 90.0 * seconds(500));
}

// Places that jitter by less than a slice is thick, each twice.
TEST(GroupSeries, ASetHasEachPlaceOnceHoweverTheyJitter) {
    std::vector<SeriesFile> files = stack({0, .012, .001, .006, 2, 2.012, 2.001, 2.006});
    for (std::size_t n = 0; n < files.size(); ++n)
        files[n].header.instanceNumber = int(n);
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 4U);
    for (const auto &entry : entries)
        EXPECT_EQ(entry.frames.size(), 2U);
}

TEST(GroupSeries, ASeriesOfManyStacksCanBeCancelled) {
    std::stop_source stop;
    stop.request_stop();
    std::vector<dicom::Skipped> skipped;
    EXPECT_THROW(dicom::groupSeries(stack({0, 0, 1, 1}), skipped, task::Progress(stop.get_token())),
                 task::Cancelled);
}

TEST(GroupSeries, OrderComesFromPositionsNotFromNames) {
    const auto entries = group(stack({10, 0, 5, 15}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].frames[0].path, "f1");
    EXPECT_EQ(entries[0].frames[3].path, "f3");
    EXPECT_NEAR(entries[0].geometry.lattice.sliceDistanceMm(), 5.0, 1e-12);
    EXPECT_TRUE(entries[0].notes.warnings.empty());
}

TEST(GroupSeries, UnevenStacksGoOntoTheGridOfTheirLongestRunAndNameTheChange) {
    const auto entries = group(stack({0, 4, 8, 9, 16, 23}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_TRUE(entries[0].placed);
    EXPECT_NEAR(entries[0].geometry.lattice.sliceDistanceMm(), 4.0, 1e-12);
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 7); // 0, 4, ... 24: the last slice is inside
    ASSERT_EQ(entries[0].notes.warnings.size(), 1U);
    EXPECT_NE(entries[0].notes.warnings[0].find("f2"), std::string::npos);
    EXPECT_NE(entries[0].notes.warnings[0].find("f3"), std::string::npos);
}

std::vector<double> evenDepths(int count, double step) {
    std::vector<double> depths;
    for (int n = 0; n < count; ++n)
        depths.push_back(n * step);
    return depths;
}

double rounded(double value, double to) {
    return std::round(value / to) * to;
}

// Slices of the lattice that are frames as they were scanned.
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
TEST(GroupSeries, AnOddGapAtAnEndBlursNothingAndLosesNothing) {
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
    EXPECT_TRUE(entries[0].notes.warnings[0].starts_with("missing slices"))
        << entries[0].notes.warnings[0];
}

TEST(GroupSeries, AHoleOfSeveralSlicesLeavesItsRunsAndTheWholeWithItFilled) {
    const auto entries = group(stack({0, 2, 4, 6, 11.5, 13.5}));
    ASSERT_EQ(entries.size(), 3U);
    EXPECT_EQ(entries[0].label, "slices 1 to 4, axial 1");
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 4);
    EXPECT_EQ(entries[1].label, "slices 5 to 6, axial 2");
    EXPECT_TRUE(entries[2].fillsHoles);
    EXPECT_EQ(entries[2].frames.size(), 6U);
    EXPECT_EQ(entries[2].geometry.lattice.size().k, 8); // 0 to 14
    EXPECT_EQ(entries[2].notes.filled, (std::vector<volume::SliceRange>{{4, 5}}));
    for (const auto &entry : entries) {
        EXPECT_TRUE(entry.placed);
        std::string all;
        for (const std::string &warning : entry.notes.warnings)
            all += warning;
        EXPECT_NE(all.find("f3"), std::string::npos) << all;
        EXPECT_NE(all.find("f4"), std::string::npos) << all;
    }
    EXPECT_EQ(group(stack({0, 2, 4, 6, 10.9, 12.9})).size(), 1U); // 2.45 gaps
    // A survey is not filled from end to end.
    for (const auto &entry : group(stack({0, 202.5, 203.75, 205})))
        EXPECT_FALSE(entry.fillsHoles);
}

// Phases with the same hole: each run is one stack.
TEST(GroupSeries, RunsOfPhasesAreTheirPhases) {
    auto files = stack({0, 2, 4, 10, 12, 14, 0, 2, 4, 10, 12, 14});
    for (int n = 0; n < 12; ++n)
        files[n].header.frames[0].dimensions["temporal position"] = n < 6 ? "1" : "2";
    std::vector<std::string> labels;
    for (const auto &entry : group(files))
        labels.push_back(entry.label);
    EXPECT_EQ(labels, (std::vector<std::string>{"temporal position 1, slices 1 to 3, axial 1",
                                                "temporal position 2, slices 1 to 3, axial 1",
                                                "temporal position 1, slices 4 to 6, axial 2",
                                                "temporal position 2, slices 4 to 6, axial 2",
                                                "temporal position 1, gaps filled, axial 3",
                                                "temporal position 2, gaps filled, axial 3"}));
}

TEST(GroupSeries, StraySlicesDoNotMultiplyTheStack) {
    // Two images a hundredth of a slice beside others: their gap is no spacing.
    const auto entries = group(stack({0, 0.05, 0.1, 5, 10, 15, 20, 25}));
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].geometry.lattice.size().k, 6);
    EXPECT_FALSE(entries[0].notes.warnings.empty());
    // Where all is fine but two slices far away, no grid holds both.
    const auto far = group(stack({0, 100, 100.5, 101}));
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
    EXPECT_NE(entries[0].notPlacedReason.find("f2"), std::string::npos);
    files[2].header.frames[0].positionMm->x = 0.19; // two pixels of 1 mm, fitted: 0.13 mm
    EXPECT_TRUE(group(files)[0].placed);
}

// Axes and pixel spacings as two computers write them.
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
          std::tuple(9e-4, 0.0, 1U), std::tuple(0.0, 1.1e-3, 1U)}) {
        const auto entries = jittered(axes, spacing);
        ASSERT_EQ(entries.size(), 1U) << axes << ' ' << spacing;
        EXPECT_EQ(entries[0].geometry.lattice.size().k, 40);
        EXPECT_EQ(entries[0].notes.warnings.size(), warnings) << axes << ' ' << spacing;
        EXPECT_NEAR(entries[0].geometry.lattice.sliceNormal().z, 1.0, 1e-6);
    }
    EXPECT_GT(jittered(0.02, 0.0).size(), 1U);
    EXPECT_GT(jittered(0.0, 0.01).size(), 1U);
}

// Anonymisers that replace every UID by itself.
TEST(GroupSeries, FramesOfReferenceThatNeverRepeatSayNothing) {
    auto files = stack(evenDepths(30, 2.0));
    for (std::size_t n = 0; n < files.size(); ++n)
        files[n].header.frameOfReferenceUid = "1.2." + std::to_string(n);
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].frames.size(), 30U);
    EXPECT_EQ(entries[0].notes.warnings.size(), 1U);
    files[7].header.frameOfReferenceUid = files[8].header.frameOfReferenceUid; // one repeats
    EXPECT_EQ(group(files).size(), 29U);
    EXPECT_EQ(group({files[0], files[1]}).size(), 2U); // two scans of one slice each
}

TEST(GroupSeries, OneInstanceUidInAllImagesLosesNone) {
    auto files = stack(evenDepths(93, 1.0));
    for (auto &f : files)
        f.header.sopInstanceUid = "1.2.3";
    files.push_back(files[4]);
    files.back().path = "copy";
    std::vector<dicom::Skipped> skipped;
    const auto entries = dicom::groupSeries(files, skipped);
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].frames.size(), 93U);
    EXPECT_EQ(entries[0].notes.warnings.size(), 1U);
    ASSERT_EQ(skipped.size(), 1U);
    EXPECT_EQ(skipped[0].path, "copy");
}

// An Enhanced file and the slices that were taken out of it.
TEST(GroupSeries, AnEnhancedFileAndItsSlicesUnderOneUidAreTwoVolumes) {
    auto files = stack(evenDepths(7, 2.0));
    SeriesFile enhanced = files[0];
    enhanced.path = "enhanced";
    for (std::size_t n = 1; n < files.size(); ++n)
        enhanced.header.frames.push_back(files[n].header.frames[0]);
    files.insert(files.begin(), enhanced);
    for (auto &f : files)
        f.header.sopInstanceUid = "1.2.3";
    std::vector<dicom::Skipped> skipped;
    const auto entries = dicom::groupSeries(files, skipped);
    EXPECT_TRUE(skipped.empty());
    ASSERT_EQ(entries.size(), 2U);
    for (const auto &entry : entries)
        EXPECT_EQ(entry.frames.size(), 7U);
}

TEST(GroupSeries, AStrayOrientationIsAVolumeOfItsOwn) {
    auto files = stack({0, 2, 4, 6});
    files[1].header.frames[0].rowAxis = glm::dvec3(0, 1, 0);
    files[1].header.frames[0].columnAxis = glm::dvec3(0, 0, -1);
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[0].frames.size() + entries[1].frames.size(), 4U);
}

TEST(GroupSeries, PositionsOfAnotherSpaceAndValuesOfAnotherKindAreOtherVolumes) {
    auto files = stack({0, 2, 4, 6, 8});
    files[1].header.frameOfReferenceUid = "1.2.3";
    files[3].header.modality = "MR";
    EXPECT_EQ(group(files).size(), 3U);
}

TEST(GroupSeries, ValuesOfWhichNobodySaysWhetherTheyAreSignedAreRefused) {
    InstanceHeader header = file("f", 0.0).header;
    header.hasPixels = true;
    header.bitsAllocated = header.bitsStored = 16;
    header.highBit = 15;
    for (const int representation : {0, 1, 2, 7, -1}) {
        header.pixelRepresentation = representation;
        EXPECT_EQ(decoder::whyUnusable(header).has_value(),
                  representation != 0 && representation != 1)
            << representation << decoder::whyUnusable(header).value_or("");
    }
}

TEST(GroupSeries, FramesThatAreNotUsedAreNoSurplus) {
    InstanceHeader header = file("f", 0.0).header;
    header.bitsAllocated = 16;
    header.announcedFrames = 10; // of which one is in use
    const auto plane = std::uint32_t(2 * header.rows * header.columns);
    header.pixelBytes = 10 * plane;
    EXPECT_FALSE(decoder::hasSurplusPixels(header));
    header.pixelBytes += plane;
    EXPECT_TRUE(decoder::hasSurplusPixels(header));
}

TEST(GroupSeries, OtherSizesAndLocalizersAreSplitOff) {
    auto files = stack({0, 2, 4, 6, 8});
    files[1].header.columns = 5;
    files[3].header.frames[0].imageType = "ORIGINAL\\PRIMARY\\LOCALIZER";
    EXPECT_EQ(group(files).size(), 3U);
}

TEST(GroupSeries, RepeatedPlacesAreSplitByWhatTellsThemApart) {
    auto files = stack({0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 6; ++n)
        files[n].header.frames[0].dimensions["temporal position"] = n < 3 ? "1" : "2";
    auto entries = group(files);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[0].label, "temporal position 1");
    EXPECT_EQ(entries[1].frames[0].path, "f3");
    // Without any attribute the order of the instances decides.
    files = stack({0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 6; ++n)
        files[n].header.instanceNumber = n + 1;
    entries = group(files);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[1].frames.size(), 3U);
}

TEST(GroupSeries, TheAttributeOfASingleSliceIsNotTakenForAVolume) {
    // Acquisition numbers that count the slices must not tear a plain stack apart.
    auto files = stack({0, 2, 4, 6});
    for (int n = 0; n < 4; ++n)
        files[n].header.frames[0].dimensions["acquisition"] = std::to_string(n);
    EXPECT_EQ(group(files).size(), 1U);
}

TEST(GroupSeries, OneInstanceTwiceIsUsedOnceAndListed) {
    auto files = stack({0, 2, 4});
    files.push_back(files[1]);
    files[3].path = "again";
    std::vector<dicom::Skipped> skipped;
    const auto entries = dicom::groupSeries(files, skipped);
    EXPECT_EQ(entries[0].frames.size(), 3U);
    ASSERT_EQ(skipped.size(), 1U);
    EXPECT_EQ(skipped[0].path, "again");
}

TEST(GroupSeries, WithoutPositionsThereAreImagesButNoVolume) {
    auto files = stack({0, 2});
    files[0].header.frames[0].positionMm.reset();
    files[1].header.frames[0].positionMm.reset();
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_FALSE(entries[0].placed);
    EXPECT_EQ(entries[0].frames.size(), 2U);
    EXPECT_FALSE(entries[0].notPlacedReason.empty());
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
