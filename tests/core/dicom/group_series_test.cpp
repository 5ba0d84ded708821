// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <ctime>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/decoding/client/dimensions.h"
#include "tests/core/dicom/series_files.h"

namespace pellucid {

namespace {

using dicom::InstanceHeader;
using dicom::SeriesFile;
using test::evenDepths;
using test::file;
using test::group;
using test::stack;

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
    EXPECT_EQ(dicom::labelText(entries[0].label), "axial 1");
    EXPECT_EQ(dicom::labelText(entries[1].label), "coronal");
    EXPECT_EQ(dicom::labelText(entries[2].label), "sagittal");
    EXPECT_EQ(dicom::labelText(entries[3].label), "axial 2");
}

// Phases of one stack share its name; a stack with another frame of reference is not one of them.
TEST(GroupSeries, PhasesOfOneStackSayThatTheyAre) {
    auto files = stack({0, 2, 4, 0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 9; ++n) {
        files[n].header.frames[0].dimensions[0x00200100] = n < 3 ? "1" : "2";
        files[n].header.frameOfReferenceUid = n < 6 ? "1.2" : "1.3";
    }
    std::vector<std::string> labels;
    for (const dicom::VolumeEntry &entry : group(files))
        labels.push_back(dicom::labelText(entry.label));
    std::sort(labels.begin(), labels.end());
    EXPECT_EQ(labels, (std::vector<std::string>{"axial 2", "temporal position 1, axial 1",
                                                "temporal position 2, axial 1"}));
}

// Thousands of images at a few positions, as in a long perfusion without any times.
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
            const std::clock_t start = std::clock(); // CPU time of this process alone
            const auto entries = group(files);
            fastest = std::min(fastest, double(std::clock() - start));
            EXPECT_EQ(entries.size(), std::size_t(sets));
            EXPECT_EQ(dicom::labelText(entries.front().label), "set 1");
            EXPECT_EQ(dicom::labelText(entries.back().label), "set " + std::to_string(sets));
            for (const auto &entry : entries)
                EXPECT_EQ(entry.frames.size(), std::size_t(places));
        }
        return fastest;
    };
    // 16 times as many images take 16 times as long, or twice that beyond the caches; not 256
    // times.
    EXPECT_LT(seconds(8000), 90.0 * seconds(500));
}

// Positions jitter by less than the slice thickness, and each occurs twice.
TEST(GroupSeries, ASetHasEachPositionOnceDespiteJitter) {
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

// Some anonymisers replace every UID independently.
TEST(GroupSeries, FramesOfReferenceThatRarelyRepeatAreIgnored) {
    auto files = stack(evenDepths(30, 2.0));
    for (std::size_t n = 0; n < files.size(); ++n)
        files[n].header.frameOfReferenceUid = "1.2." + std::to_string(n);
    const auto entries = group(files);
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].frames.size(), 30U);
    EXPECT_EQ(entries[0].notes.warnings.size(), 1U);
    files[7].header.frameOfReferenceUid = files[8].header.frameOfReferenceUid; // one repeats
    EXPECT_EQ(group(files).size(), 1U);
    for (std::size_t n = 0; n < 16; ++n) // half of them share one
        files[n].header.frameOfReferenceUid = "1.2.3";
    EXPECT_EQ(group(files).size(), 15U);
    EXPECT_EQ(group({files[20], files[21]}).size(), 2U); // two scans of one slice each
}

TEST(GroupSeries, ASharedInstanceUidLosesNoImage) {
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

// An Enhanced file and the slices that were extracted from it.
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

TEST(GroupSeries, DifferentSpacesAndKindsOfValuesAreDifferentVolumes) {
    auto files = stack({0, 2, 4, 6, 8});
    files[1].header.frameOfReferenceUid = "1.2.3";
    files[3].header.modality = "MR";
    EXPECT_EQ(group(files).size(), 3U);
}

TEST(GroupSeries, ValuesOfUnknownSignednessAreRefused) {
    InstanceHeader header = file("f", 0.0).header;
    header.hasPixels = true;
    header.bitsAllocated = header.bitsStored = 16;
    header.highBit = 15;
    for (const int representation : {0, 1, 2, 7, -1}) {
        header.pixelRepresentation = representation;
        const auto reason = decoding::whyUnusable(header);
        EXPECT_EQ(reason.has_value(), representation != 0 && representation != 1)
            << representation << (reason ? reason->english() : "");
    }
}

TEST(GroupSeries, UnusedFramesAreNotSurplus) {
    InstanceHeader header = file("f", 0.0).header;
    header.bitsAllocated = 16;
    header.declaredFrames = 10; // of which one is in use
    const auto plane = std::uint32_t(2 * header.rows * header.columns);
    header.pixelBytes = 10 * plane;
    EXPECT_FALSE(decoding::hasSurplusPixels(header));
    header.pixelBytes += plane;
    EXPECT_TRUE(decoding::hasSurplusPixels(header));
}

TEST(GroupSeries, OtherSizesAndLocalizersAreSplitOff) {
    auto files = stack({0, 2, 4, 6, 8});
    files[1].header.columns = 5;
    files[3].header.frames[0].dimensions[decoding::imageTypeTag] = "ORIGINAL\\PRIMARY\\LOCALIZER";
    EXPECT_EQ(group(files).size(), 3U);
}

TEST(GroupSeries, RepeatedPlacesAreSplitByWhatTellsThemApart) {
    auto files = stack({0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 6; ++n)
        files[n].header.frames[0].dimensions[0x00200100] = n < 3 ? "1" : "2";
    auto entries = group(files);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(dicom::labelText(entries[0].label), "temporal position 1");
    EXPECT_EQ(entries[1].frames[0].path, "f3");
    // Without any attribute the order of the instances decides.
    files = stack({0, 2, 4, 0, 2, 4});
    for (int n = 0; n < 6; ++n)
        files[n].header.instanceNumber = n + 1;
    entries = group(files);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[1].frames.size(), 3U);
}

TEST(GroupSeries, AnAttributeThatCountsSlicesDoesNotSplitTheStack) {
    // Acquisition numbers that count the slices must not tear a plain stack apart.
    auto files = stack({0, 2, 4, 6});
    for (int n = 0; n < 4; ++n)
        files[n].header.frames[0].dimensions[0x00200012] = std::to_string(n);
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

} // namespace
} // namespace pellucid
