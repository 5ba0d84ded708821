// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "core/dicom/reasons.h"
#include "core/dicom/write_series.h"
#include "core/task/error.h"
#include "core/volume/reasons.h"
#include "tests/core/dicom/habit_frames.h"
#include "tests/core/dicom/written_series.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using test::loadDefault;
using test::modify;
using test::tiltedHead;

TEST(Load, ATruncatedSliceIsNamedAndInterpolated) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const fs::path victim = folder / "IM0004.dcm";
    fs::resize_file(victim, fs::file_size(victim) - 700);
    const auto catalogue = dicom::scan({folder.path()});
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    std::vector<dicom::Skipped> skipped = catalogue.skipped;
    skipped.insert(skipped.end(), loaded.skipped.begin(), loaded.skipped.end());
    ASSERT_EQ(skipped.size(), 1U);
    EXPECT_EQ(skipped[0].path, victim);
    // Seven slices again: the hole is interpolated, and the volume says so.
    EXPECT_EQ(loaded.volume.lattice().size().k, 7);
    bool isReported = false;
    for (const task::Reason &warning : loaded.volume.notes().warnings)
        isReported = isReported || warning.is(task::because::missingSlices);
    EXPECT_TRUE(isReported);
}

TEST(Load, StopsWhenCancelled) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const auto catalogue = dicom::scan({folder.path()});
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(dicom::loadVolume(*dicom::defaultSelection(catalogue).volume,
                                   task::Progress(source.get_token())),
                 task::Cancelled);
    EXPECT_THROW(dicom::scan({folder.path()}, task::Progress(source.get_token())), task::Cancelled);
}

// Each slice has its own rescale. The same one for all slices would show stripes.
TEST(Load, TheRescaleOfEverySliceIsItsOwn) {
    const test::TemporaryFolder folder;
    const volume::Volume head = tiltedHead();
    dicom::writeCtSeries(folder.path(), head, {}, dicom::TransferSyntax::explicitLittle);
    const std::string third = (folder / "IM0003.dcm").string();
    ASSERT_EQ(std::system(("dcmodify -nb -m RescaleIntercept=-1000 -m RescaleSlope=2 '" + third +
                           "' > /dev/null")
                              .c_str()),
              0);
    const auto loaded = loadDefault(folder.path()).volume;
    const auto size = head.lattice().size();
    ASSERT_EQ(loaded.lattice().size(), size);
    for (int k = 0; k < size.k; ++k)
        for (int i = 0; i < size.i; ++i) {
            const double stored = head.value({i, size.j / 2, k});
            EXPECT_EQ(loaded.value({i, size.j / 2, k}), k == 2 ? 2.0 * stored - 1000.0 : stored);
        }
}

// Half a number, or none, would silently give other values.
TEST(Load, AnInvalidRescaleCostsItsSlice) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const auto modified = [&](const char *file, const std::string &change) {
        return std::system(
            ("dcmodify -nb -m '" + change + "' '" + (folder / file).string() + "' > /dev/null")
                .c_str());
    };
    const std::vector<std::string> changes{"RescaleSlope=2,5,1", "RescaleSlope=nan",
                                           "RescaleIntercept=abc", "RescaleSlope=1e300"};
    for (std::size_t n = 0; n < changes.size(); ++n)
        ASSERT_EQ(modified(("IM000" + std::to_string(n + 1) + ".dcm").c_str(), changes[n]), 0);
    ASSERT_EQ(modified("IM0006.dcm", "RescaleSlope=+1.0 "), 0);
    const auto catalogue = dicom::scan({folder.path()});
    ASSERT_EQ(catalogue.skipped.size(), changes.size());
    for (const auto &skipped : catalogue.skipped)
        EXPECT_EQ(skipped.reason.english(), "has an unusable rescale slope or intercept");
    // Blanks are no value: that image stands alone. Some programs write a meaningless slope of 0,
    // which is reported.
    ASSERT_EQ(modified("IM0005.dcm", "RescaleIntercept=  "), 0);
    ASSERT_EQ(modified("IM0007.dcm", "RescaleSlope=0"), 0);
    const auto loaded = loadDefault(folder.path()).volume;
    EXPECT_EQ(loaded.lattice().size().k, 2);
    EXPECT_THAT(loaded.notes().warnings, testing::Contains(task::because::zeroSlopes(1)));
}

// Codes are refused if the rescale maps them to one number in 24 bits. If it nearly does, they are
// shown with a warning.
TEST(Load, ARescaleToOneValueIsReported) {
    const auto outcome = [](const std::string &rescale) -> std::string {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), tiltedHead(), {},
                             dicom::TransferSyntax::explicitLittle);
        std::vector<fs::path> files;
        for (const auto &file : fs::directory_iterator(folder.path()))
            files.push_back(file.path());
        EXPECT_TRUE(modify(rescale, files));
        try {
            const dicom::LoadedVolume loaded = loadDefault(folder.path());
            for (const task::Reason &warning : loaded.volume.notes().warnings)
                if (warning.is(task::because::valuesAreShownAsEqual))
                    return "equal";
            return "shown";
        } catch (const task::Error &error) {
            return error.reason().is(task::because::valuesAreOne) ? "refused"
                                                                  : error.reason().english();
        }
    };
    EXPECT_EQ(outcome("-m RescaleIntercept=1e7 -m RescaleSlope=.001"), "refused");
    EXPECT_EQ(outcome("-m RescaleIntercept=1e8 -m RescaleSlope=1"), "refused");
    EXPECT_EQ(outcome("-m RescaleIntercept=1e5 -m RescaleSlope=.005"), "equal");
    EXPECT_EQ(outcome("-m RescaleIntercept=1e5 -m RescaleSlope=.1"), "shown");
    EXPECT_EQ(outcome("-m RescaleIntercept=1e6 -m RescaleSlope=1"), "shown");
    EXPECT_EQ(outcome("-m RescaleIntercept=-10.5 -m RescaleSlope=.001"), "shown");
}

// 18 of 20 images have a frame of reference of their own, just enough to ignore it. Without the
// lost slice it is 17 of 19, which is not enough.
TEST(Load, ALostSliceDoesNotSplitItsVolumeByFrameOfReference) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(20), {}, dicom::TransferSyntax::explicitLittle);
    for (int n = 1; n <= 18; ++n)
        ASSERT_TRUE(modify("-m FrameOfReferenceUID=1.2." + std::to_string(n),
                           {folder / fmt::format("IM{:04}.dcm", n)}));
    const auto catalogue = dicom::scan({folder.path()});
    ASSERT_EQ(dicom::selections(catalogue).size(), 1U);
    fs::remove(folder / "IM0005.dcm");
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    EXPECT_EQ(loaded.skipped.size(), 1U);
    EXPECT_EQ(loaded.volume.lattice().size().k, 20); // the lost one is interpolated
}

TEST(Load, SurplusPixelsAreReported) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const auto warnings = [&] {
        std::vector<std::string> texts;
        const auto catalogue = dicom::scan({folder.path()});
        for (const auto &warning : dicom::defaultSelection(catalogue).volume->notes.warnings)
            texts.push_back(warning.english());
        return texts;
    };
    const auto before = warnings();
    // Pixel Data (7FE0,0010), OW, is the last element: append a row.
    const fs::path path = folder / "IM0002.dcm";
    std::string bytes = test::readText(path);
    const std::string tag{'\xE0', '\x7F', '\x10', '\0', 'O', 'W', '\0', '\0'};
    const auto at = bytes.find(tag) + tag.size();
    ASSERT_LT(at, bytes.size());
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + at, 4);
    ASSERT_EQ(at + 4 + length, bytes.size());
    length += 66;
    std::memcpy(bytes.data() + at, &length, 4);
    test::writeText(path, bytes + std::string(66, '\1'));
    auto expected = before;
    expected.insert(expected.begin(), "files with more pixels than their header says: 1");
    auto found = warnings();
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(loadDefault(folder.path()).skipped.empty());
}

// Counts how often each file of a folder is opened.
class OpenCounter {
public:
    explicit OpenCounter(const fs::path &folder)
        : m_queue(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
          m_watch(::inotify_add_watch(m_queue, folder.c_str(), IN_OPEN)) {}
    ~OpenCounter() { ::close(m_queue); }
    OpenCounter(const OpenCounter &) = delete;
    OpenCounter &operator=(const OpenCounter &) = delete;

    bool works() const { return m_watch >= 0; }
    std::map<std::string, int> counts() const {
        std::map<std::string, int> counts;
        alignas(inotify_event) std::array<char, 65536> events{};
        const ssize_t bytes = ::read(m_queue, events.data(), events.size());
        for (ssize_t at = 0; at < bytes;) {
            const auto *const event = reinterpret_cast<const inotify_event *>(events.data() + at);
            if (event->len > 0 && (event->mask & IN_ISDIR) == 0)
                ++counts[event->name];
            at += ssize_t(sizeof(inotify_event) + event->len);
        }
        return counts;
    }

private:
    int m_queue, m_watch;
};

// The first file decides the type of the samples, but is not decoded again for them.
TEST(Load, EveryFileIsDecodedOnce) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const auto catalogue = dicom::scan({folder.path()});
    const OpenCounter opened(folder.path());
    if (!opened.works())
        GTEST_SKIP() << "this system does not tell what is opened";
    dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    const auto counts = opened.counts();
    EXPECT_EQ(counts.size(), 7U);
    for (const auto &[name, count] : counts)
        EXPECT_EQ(count, 1) << name;
}

// A slope of 1/2 in the first file would make all samples floats, but its pixels are damaged.
TEST(Load, TheFirstReadableFileDecidesTheType) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs;
    knobs.change = [](test::DicomWriter &w, int slice) {
        const std::string pixels = w.text(test::DicomWriter::pixelData);
        w.remove(test::DicomWriter::pixelData);
        w.putFragments({test::runLengths(pixels, slice == 0 ? 3 : 0)});
        if (slice == 0)
            w.putNumbers({0x0028, 0x1053}, {0.5});
    };
    test::writeSeries(folder.path(), knobs, {.syntax = "1.2.840.10008.1.2.5"});
    const auto loaded = loadDefault(folder.path());
    ASSERT_EQ(loaded.skipped.size(), 1U);
    EXPECT_EQ(loaded.skipped[0].path.filename(), "S001.dcm");
    EXPECT_EQ(loaded.volume.lattice().size().k, knobs.slices - 1);
    EXPECT_FALSE(loaded.volume.isFloat());
}

} // namespace
} // namespace pellucid
