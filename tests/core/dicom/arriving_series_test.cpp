// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include <glm/geometric.hpp>

#include "core/archive/instance_list.h"
#include "core/decoding/client/decoder.h"
#include "core/dicom/arriving_series.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/task/error.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using dicom::ArrivingSeries;
using dicom::PartialVolume;

constexpr int slices = 65;

// The files of a series, in the order of their slices.
std::vector<fs::path> filesOfSeries(const fs::path &folder, const test::SeriesKnobs &knobs) {
    test::writeSeries(folder, knobs);
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

test::SeriesKnobs unevenValues() {
    test::SeriesKnobs knobs;
    knobs.slices = slices;
    knobs.value = [](int i, int j, int k) { return 10 * k * k % 977 + 3 * j - i; };
    return knobs;
}

std::vector<double> valuesOf(const volume::Volume &volume) {
    std::vector<double> values;
    volume.visit([&](auto samples) { values.assign(samples.begin(), samples.end()); });
    return values;
}

// Sends files one by one, and returns what was shown. Where a finer part can be shown, the next
// file waits for it, however busy the machine is, unless this series shows no parts.
struct Shown {
    std::vector<PartialVolume> partial;
    dicom::ArrivedSeries arrived;
};
Shown arrive(const std::vector<fs::path> &files, const std::vector<std::size_t> &order,
             std::chrono::milliseconds patience = std::chrono::seconds(3)) {
    constexpr std::size_t coarsestAfterTheFirst = 8, leastToShow = 16;
    ArrivingSeries series(files.size());
    Shown shown;
    std::mutex mutex;
    std::condition_variable changed;
    std::jthread sender([&] {
        std::vector<bool> isHere(files.size());
        std::size_t awaited = files.size() + 1;
        for (const std::size_t n : order) {
            series.add(n, files[n]);
            isHere[n] = true;
            const std::size_t stride = dicom::finestStride(isHere);
            const bool isFirst = awaited > files.size();
            if (files.size() < leastToShow || stride < 2 || stride >= awaited ||
                (!isFirst && stride > coarsestAfterTheFirst))
                continue;
            awaited = stride;
            std::unique_lock lock(mutex);
            changed.wait_for(lock, patience, [&] {
                return !shown.partial.empty() && shown.partial.back().stride <= stride;
            });
        }
        series.end();
    });
    shown.arrived = series.load({}, [&](const PartialVolume &partial, const task::Progress &) {
        const std::lock_guard lock(mutex);
        shown.partial.push_back(partial);
        changed.notify_all();
    });
    return shown;
}

TEST(ArrivingSeries, FinestStride) {
    std::vector<bool> here(17);
    EXPECT_EQ(dicom::finestStride(here), 0U);
    here[0] = true;
    EXPECT_EQ(dicom::finestStride(here), 0U); // the other end lacks
    here[16] = true;
    EXPECT_EQ(dicom::finestStride(here), 16U);
    here[8] = here[4] = true;
    EXPECT_EQ(dicom::finestStride(here), 8U);
    here[12] = true;
    EXPECT_EQ(dicom::finestStride(here), 4U);
    EXPECT_EQ(dicom::finestStride(std::vector<bool>(17, true)), 1U);
    EXPECT_EQ(dicom::finestStride({}), 0U);
}

// Whatever way it came, it is what opening its folder gives, bit by bit.
TEST(ArrivingSeries, IsInTheEndWhatItIsOnDisk) {
    const test::TemporaryFolder folder;
    const auto files = filesOfSeries(folder / "series", unevenValues());
    const auto catalogue = dicom::scan({folder / "series"});
    const volume::Volume expected =
        dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const Shown shown = arrive(files, archive::coarseToFine(files.size()));
    const volume::Volume &found = shown.arrived.loaded.volume;
    EXPECT_TRUE(found.lattice() == expected.lattice());
    EXPECT_EQ(valuesOf(found), valuesOf(expected));
    EXPECT_EQ(found.unit(), expected.unit());
    EXPECT_EQ(found.notes().warnings, expected.notes().warnings);
    EXPECT_EQ(dicom::defaultSelection(*shown.arrived.catalogue).volume->frames,
              dicom::defaultSelection(catalogue).volume->frames);
}

// A part is the right box from the first slices on; those that are there are true, those between
// are interpolated, and it says how many there are.
TEST(ArrivingSeries, PartsAreInPlaceAndBecomeFiner) {
    const test::TemporaryFolder folder;
    const auto files = filesOfSeries(folder / "series", unevenValues());
    for (const bool isReversed : {false, true}) {
        std::vector<fs::path> listed = files;
        if (isReversed) // numbers may run against the positions
            std::reverse(listed.begin(), listed.end());
        const Shown shown = arrive(listed, archive::coarseToFine(listed.size()));
        const volume::Volume &whole = shown.arrived.loaded.volume;
        ASSERT_GE(shown.partial.size(), 4U);
        EXPECT_GT(shown.partial.front().stride, 8U);
        EXPECT_EQ(shown.partial.back().stride, 2U);
        std::size_t stride = std::size_t(slices);
        for (const PartialVolume &part : shown.partial) {
            EXPECT_LT(part.stride, stride);
            stride = part.stride;
            EXPECT_EQ(part.count, std::size_t(slices));
            EXPECT_TRUE(part.volume.lattice().fillsSameBox(whole.lattice()));
            EXPECT_EQ(part.volume.unit(), volume::ValueUnit::hounsfield);
            ASSERT_EQ(part.volume.notes().warnings.size(), 1U);
            EXPECT_TRUE(part.volume.notes().warnings[0].is(task::because::slicesOfSeries));
            const int step = int(stride);
            if (step > 8) { // fewer slices, between those that are there
                const volume::Lattice &coarse = part.volume.lattice();
                ASSERT_EQ(coarse.size().k, 48);
                for (int k = 0; k < coarse.size().k; ++k) {
                    const double at =
                        whole.lattice().voxel(coarse.patient(volume::VoxelIndex{4, 3, k})).v.z;
                    const int below = std::min(int(at) / step * step, slices - 1),
                              above = std::min(below + step, slices - 1);
                    const double share = above > below ? (at - below) / (above - below) : 0.0;
                    EXPECT_NEAR(part.volume.value({4, 3, k}),
                                (1.0 - share) * whole.value({4, 3, below}) +
                                    share * whole.value({4, 3, above}),
                                0.51)
                        << k;
                }
                continue;
            }
            ASSERT_EQ(part.volume.lattice().size().k, slices);
            for (int k = 0; k < slices; k += step)
                EXPECT_EQ(part.volume.value({4, 3, k}), whole.value({4, 3, k})) << k;
        }
        // Of the last part, the odd slices are means of their neighbors, but for those that came.
        const volume::Volume &last = shown.partial.back().volume;
        int means = 0;
        for (int k = 1; k < slices; k += 2)
            means += std::abs(last.value({4, 3, k}) - 0.5 * (whole.value({4, 3, k - 1}) +
                                                             whole.value({4, 3, k + 1}))) <= 0.5
                         ? 1
                         : 0;
        EXPECT_GE(means, slices / 2 - 4);
    }
}

// Several connections bring slices in any order. Whatever gaps the first ones leave, they are shown
// in the box of the whole.
TEST(ArrivingSeries, TheGapsOfTheFirstSlicesMeanNothing) {
    const test::TemporaryFolder folder;
    const auto files = filesOfSeries(folder / "series", unevenValues());
    const auto catalogue = dicom::scan({folder / "series"});
    const volume::Lattice whole = dicom::defaultSelection(catalogue).volume->geometry.lattice;
    // Two gaps without a common step; two runs; a run beside a single slice.
    const std::vector<std::vector<std::size_t>> bursts{
        {0, 64, 62}, {0, 64, 62, 8}, {0, 64, 48, 56}};
    for (const bool isReversed : {false, true})
        for (const std::vector<std::size_t> &burst : bursts) {
            SCOPED_TRACE(testing::PrintToString(burst) + (isReversed ? ", reversed" : ""));
            std::vector<fs::path> listed = files;
            if (isReversed) // numbers may run against the positions
                std::reverse(listed.begin(), listed.end());
            ArrivingSeries series(listed.size());
            for (const std::size_t n : burst)
                series.add(n, listed[n]);
            std::optional<PartialVolume> first;
            std::promise<void> isShown;
            const std::future<void> shown = isShown.get_future();
            std::jthread sender([&] {
                shown.wait_for(std::chrono::seconds(60)); // a loaded machine
                for (std::size_t n = 0; n < listed.size(); ++n)
                    series.add(n, listed[n]);
            });
            (void)series.load({}, [&](const PartialVolume &part, const task::Progress &) {
                if (first)
                    return;
                first.emplace(part);
                isShown.set_value();
            });
            ASSERT_TRUE(first.has_value());
            EXPECT_EQ(first->slices, burst.size());
            EXPECT_TRUE(first->volume.lattice().fillsSameBox(whole));
        }
}

TEST(ArrivingSeries, WhatDoesNotComeOrCannotBeReadLacks) {
    const test::TemporaryFolder folder;
    auto files = filesOfSeries(folder / "series", unevenValues());
    std::ofstream(files[10], std::ios::trunc) << "no image";
    auto order = archive::coarseToFine(files.size());
    std::erase(order, 20U);
    const Shown shown = arrive(files, order);
    EXPECT_EQ(shown.arrived.loaded.volume.lattice().size().k, slices); // two holes, interpolated
    ASSERT_EQ(shown.arrived.catalogue->skipped.size(), 1U);
    EXPECT_EQ(shown.arrived.catalogue->skipped[0].path, files[10]);
    // A part of a series says first that it is one.
    const auto &warnings = shown.arrived.loaded.volume.notes().warnings;
    ASSERT_GE(warnings.size(), 2U);
    EXPECT_EQ(warnings.front(),
              task::Reason(task::because::slicesOfSeries(files.size() - 1, files.size())));
}

// Files that the server did not list belong to the volume, too.
TEST(ArrivingSeries, UnlistedFilesBelongToIt) {
    const test::TemporaryFolder folder;
    const auto files = filesOfSeries(folder / "series", unevenValues());
    constexpr std::size_t listed = 8;
    ArrivingSeries series(listed, files.size() - listed);
    for (std::size_t n = 0; n < files.size(); ++n)
        if (n < listed)
            series.add(n, files[n]);
        else
            series.addUnlisted(files[n]);
    const auto arrived = series.load({}, {});
    EXPECT_EQ(arrived.loaded.volume.lattice().size().k, slices);
    EXPECT_TRUE(arrived.loaded.volume.notes().warnings.empty());
}

TEST(ArrivingSeries, NothingAndCancelAreErrors) {
    ArrivingSeries nothing(4);
    nothing.end();
    EXPECT_THROW((void)nothing.load({}, {}), task::Error);
    ArrivingSeries waiting(4);
    std::stop_source stop;
    std::jthread canceller([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        stop.request_stop();
    });
    EXPECT_THROW((void)waiting.load(task::Progress(stop.get_token()), {}), task::Cancelled);
}

// Real series, tilted ones, phases and odd ones among them: whatever is shown before is in place,
// and what comes in the end is what is on the disk.
TEST(ArrivingSeries, RealSeriesArriveAsTheyAre) {
    PELLUCID_NEEDS_TEST_DATA();
    int shownBefore = 0;
    for (const char *const name :
         {"ct_chest_philips_64", "ct_head_tilt_ge_28", "mr_t1_sag_siemens_35",
          "nasty_mr_12bit_signed", "nasty_mr_duplicate_pos_ge_8", "nasty_ct_missing_slice_ge_4",
          "nasty_ct_mixed_series_philips", "nasty_mr_enhanced_siemens_xa10"}) {
        const auto catalogue = dicom::scan({test::testData() / name});
        const dicom::Selection selected = dicom::defaultSelection(catalogue);
        const volume::Volume expected = dicom::loadVolume(*selected.volume).volume;
        std::vector<std::pair<int, fs::path>> numbered;
        for (const dicom::InstanceFile &file : selected.series->files)
            numbered.emplace_back(decoding::Decoder::shared().header(file.path).instanceNumber,
                                  file.path);
        std::sort(numbered.begin(), numbered.end());
        std::vector<fs::path> files;
        for (const auto &[number, path] : numbered)
            files.push_back(path);
        const Shown shown =
            arrive(files, archive::coarseToFine(files.size()), std::chrono::seconds(1));
        const volume::Volume &found = shown.arrived.loaded.volume;
        EXPECT_TRUE(found.lattice() == expected.lattice()) << name;
        EXPECT_EQ(valuesOf(found), valuesOf(expected)) << name;
        EXPECT_EQ(found.notes().warnings, expected.notes().warnings) << name;
        shownBefore += shown.partial.empty() ? 0 : 1;
        for (const PartialVolume &part : shown.partial)
            EXPECT_LT(
                glm::distance(part.volume.lattice().center().mm, expected.lattice().center().mm),
                expected.lattice().longestStepMm())
                << name;
    }
    EXPECT_GE(shownBefore, 3);
}

// Phases at the same places, and pictures without places, are not interpolated.
TEST(ArrivingSeries, SeriesThatAreNoStackAreNotShownBefore) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs = unevenValues();
    knobs.change = [](test::DicomWriter &w, int) { w.remove({0x0020, 0x0032}); };
    const auto files = filesOfSeries(folder / "unplaced", knobs);
    EXPECT_TRUE(arrive(files, archive::coarseToFine(files.size()), std::chrono::milliseconds(50))
                    .partial.empty());
}

} // namespace

} // namespace pellucid
