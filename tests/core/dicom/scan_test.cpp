// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "core/dicom/write_series.h"
#include "core/task/error.h"
#include "tests/core/dicom/written_series.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using test::modify;
using test::tiltedHead;

TEST(Scan, ListsEveryFileThatIsNotUsed) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    std::ofstream(folder / "notes.txt")
        << "not an image, but long enough to hold a header of some kind or other";
    std::ofstream(folder / "empty.dcm");
    fs::create_directory(folder / "inner");
    fs::copy_file(folder / "IM0001.dcm", folder / "inner/copy.dcm");
    fs::create_directory_symlink(folder.path(), folder / "inner/loop");
    fs::create_symlink(folder / "nowhere", folder / "dangling");
    const auto catalogue = dicom::scan({folder.path()});
    std::vector<std::string> names;
    for (const auto &s : catalogue.skipped) {
        names.push_back(s.path.filename().string());
        EXPECT_FALSE(s.reason.english().empty());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names,
              (std::vector<std::string>{"copy.dcm", "dangling", "empty.dcm", "loop", "notes.txt"}));
    EXPECT_EQ(dicom::selections(catalogue).size(), 1U);
}

TEST(Scan, UnusablePathsAreNamed) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(dicom::scan({folder.path()}).empty());
    try {
        dicom::scan({folder / "absent"});
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        EXPECT_NE(std::string(error.what()).find("absent"), std::string::npos);
    }
}

TEST(Scan, TwoSeriesAreNeverMerged) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder / "a", tiltedHead(), {.seriesNumber = 1},
                         dicom::TransferSyntax::explicitLittle);
    dicom::writeCtSeries(folder / "b", tiltedHead(), {.seriesNumber = 2},
                         dicom::TransferSyntax::explicitLittle);
    const auto catalogue = dicom::scan({folder.path()});
    EXPECT_EQ(dicom::selections(catalogue).size(), 2U);
    EXPECT_EQ(dicom::selectSeries(catalogue, "2").series->number, 2);
    EXPECT_THROW(dicom::selectSeries(catalogue, "3"), task::Error);
}

// Names are in the character sets of PS3.3, C.12.1.1.2, with the examples of PS3.5, H.3.1 and
// H.3.2. A damaged text does not keep another from being read.
TEST(Scan, NamesOfManyCharacterSetsAreRead) {
    const std::vector<std::array<std::string, 3>> names{
        {"ISO_IR 100",
         "M\xFC"
         "ller",
         "M\u00FCller"},
        {"ISO_IR 101", "Wa\xB3\xEAsa", "Wa\u0142\u0119sa"},
        {"ISO_IR 144", "\xBB\xEEpce", "\u041B\u044Epce"},
        {"ISO_IR 126", "\xC4\xE9\xEF", "\u0394\u03B9\u03BF"},
        {"ISO_IR 127", "\xE2\xC8", "\u0642\u0628"},
        {"ISO_IR 138", "\xF9\xF8", "\u05E9\u05E8"},
        {"ISO_IR 148",
         "\xC7"
         "elik",
         "\u00C7elik"},
        {"ISO_IR 166", "\xCA\xC1", "\u0E2A\u0E21"},
        {"ISO_IR 203", "\xBCuvre^\xA4", "\u0152uvre^\u20AC"},
        {"ISO_IR 192", "\xE5\xB1\xB1^\xC3\xA9", "\u5C71^\u00E9"},
        {"ISO_IR 192\\ISO 2022 IR 100", "\xE5\xB1\xB1^\xC3\xA9", "\u5C71^\u00E9"},
        {"GB18030", "Wang^\xD0\xA1\xB6\xAB", "Wang^\u5C0F\u4E1C"},
        {"GBK", "\xD0\xA1", "\u5C0F"},
        {"\\ISO 2022 IR 149", "Hong=\x1b$)C\xFB\xF3", "Hong=\u6D2A"},
        {"ISO 2022 IR 13\\ISO 2022 IR 87", "\x1b$B-!;3\x1b(J", "?\u5C71"},
        {"ISO 2022 IR 100\\ISO 2022 IR 87", "M\xDCLLER=\x1b$B;3ED\x1b(B",
         "M\u00DCLLER=\u5C71\u7530"},
        {"\\ISO 2022 IR 126\\ISO 2022 IR 87", "\x1b-F\xC4^\x1b-F\xC4\xFF=\xC4", "\u0394^\u0394?=?"},
        {"ISO 2022 IR 203\\ISO 2022 IR 144", "\xA4^\x1b-L\xD2", "\u20AC^\u0432"},
        {"\\ISO 2022 IR 87",
         "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B=\x1b$B$d$^$@\x1b(B^\x1b$B$?$m$&\x1b(B",
         "Yamada^Tarou=\u5C71\u7530^\u592A\u90CE=\u3084\u307E\u3060^\u305F\u308D\u3046"},
        {"ISO 2022 IR 13\\ISO 2022 IR 87",
         "\xD4\xCF\xC0\xDE^\xC0\xDB\xB3=\x1b$B;3ED\x1b(J^\x1b$BB@O:\x1b(J",
         "\uFF94\uFF8F\uFF80\uFF9E^\uFF80\uFF9B\uFF73=\u5C71\u7530^\u592A\u90CE"}};
    for (const auto &[sets, written, read] : names) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), tiltedHead(), {.patientName = "X"},
                             dicom::TransferSyntax::explicitLittle);
        ASSERT_TRUE(modify("-i SpecificCharacterSet='" + sets +
                               "' -i InstitutionName='\xFF' -m PatientName='" + written + "'",
                           {folder / "IM0001.dcm"}));
        const auto catalogue = dicom::scan({folder / "IM0001.dcm"});
        EXPECT_EQ(catalogue.patients.at(0).name, read) << sets;
    }
}

TEST(Scan, SignednessIsNotGuessed) {
    for (const char *change : {"-ea PixelRepresentation", "-m PixelRepresentation=2"}) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), tiltedHead(), {},
                             dicom::TransferSyntax::explicitLittle);
        ASSERT_TRUE(modify(change, {folder / "IM0003.dcm"}));
        const auto catalogue = dicom::scan({folder.path()});
        ASSERT_EQ(catalogue.skipped.size(), 1U) << change;
        EXPECT_EQ(catalogue.skipped[0].reason.english(),
                  "does not say whether its values are signed");
    }
}

TEST(Scan, DetachedSamplesAreNotReportedAsUnused) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "head.nhdr",
                    "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n"
                    "space: left-posterior-superior\n"
                    "space directions: (1,0,0) (0,1,0) (0,0,1)\ndata file: head.raw\n");
    test::writeText(folder / "head.raw", std::string(64, 'a'));
    test::writeText(folder / "other.raw", std::string(64, 'a'));
    const auto catalogue = dicom::scan({folder.path()});
    ASSERT_EQ(catalogue.skipped.size(), 1U);
    EXPECT_EQ(catalogue.skipped[0].path, folder / "other.raw");
    EXPECT_EQ(dicom::selections(catalogue).size(), 1U);
}

// The frame of reference passes through the file, the decoder and the grouping.
TEST(Scan, AnotherSpaceIsAnotherVolume) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    ASSERT_TRUE(modify("-m FrameOfReferenceUID=1.2.3",
                       {folder / "IM0001.dcm", folder / "IM0002.dcm", folder / "IM0003.dcm"}));
    const auto all = dicom::selections(dicom::scan({folder.path()}));
    EXPECT_EQ(all.size(), 2U);
}

// An index must not lead out of its folder, neither by a path nor by a link.
TEST(Scan, ADicomdirCannotLeaveItsFolder) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder / "disc/D", tiltedHead(), {.patientName = "X", .patientId = "1"},
                         dicom::TransferSyntax::explicitLittle);
    for (int n = 1; n <= 7; ++n) // as a disc names them
        fs::rename(folder / ("disc/D/IM000" + std::to_string(n) + ".dcm"),
                   folder / ("disc/D/IM" + std::to_string(n)));
    const std::string disc = "'" + (folder / "disc").string() + "'";
    ASSERT_EQ(std::system(("cd " + disc + " && dcmmkdir -Pgp +r D > /dev/null 2>&1").c_str()), 0);
    const fs::path index = folder / "disc/DICOMDIR";
    EXPECT_EQ(dicom::selections(dicom::scan({index})).size(), 1U);
    const auto bytes = test::readText(index);
    const auto at = bytes.find("D\\IM3");
    ASSERT_NE(at, std::string::npos);
    fs::copy_file(folder / "disc/D/IM3", folder / "secret");
    for (const char *name : {"..\\..", "../..", "D/IM3"}) {
        std::string changed = bytes;
        changed.replace(at, 5, name);
        test::writeText(index, changed);
        EXPECT_THROW(dicom::scan({index}), task::Error) << name;
    }
    test::writeText(index, bytes);
    fs::remove(folder / "disc/D/IM3");
    fs::create_symlink(folder / "secret", folder / "disc/D/IM3");
    const auto catalogue = dicom::scan({index});
    ASSERT_EQ(catalogue.skipped.size(), 1U);
    EXPECT_EQ(catalogue.skipped[0].reason.english(), "refers to a file outside its folder");
}

// The number of pages of a folder's files that are in memory, counted without reading them.
std::size_t residentPages(const std::filesystem::path &folder) {
    std::size_t resident = 0;
    for (const auto &entry : std::filesystem::directory_iterator(folder)) {
        const int fd = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        const std::size_t bytes = entry.file_size();
        void *const data = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, fd, 0);
        std::vector<unsigned char> pages((bytes + 4095) / 4096);
        ::mincore(data, bytes, pages.data());
        for (const unsigned char page : pages)
            resident += page & 1U;
        ::munmap(data, bytes);
        ::close(fd);
    }
    return resident;
}

void dropFromMemory(const std::filesystem::path &folder) {
    for (const auto &entry : std::filesystem::directory_iterator(folder)) {
        const int fd = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        ::fsync(fd);
        ::posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED);
        ::close(fd);
    }
}

// Network shares and CDs are slow: pixels are not read until a series is opened.
TEST(Scan, ReadsHeadersAndNotPixels) {
    const test::TemporaryFolder folder;
    const auto lattice = volume::Lattice::centred({512, 512, 8}, {1, 1, 2});
    dicom::writeCtSeries(folder.path(),
                         volume::Volume(lattice,
                                        std::vector<std::int16_t>(lattice.size().count(), 40),
                                        volume::ValueUnit::hounsfield),
                         {}, dicom::TransferSyntax::explicitLittle);
    dropFromMemory(folder.path());
    if (residentPages(folder.path()) > 0)
        GTEST_SKIP() << "this file system keeps files in memory";
    dicom::scan({folder.path()});
    // Eight files of 128 pages; a header is one or two, and the system reads a few more.
    const std::size_t read = residentPages(folder.path());
    EXPECT_GT(read, 0U);
    EXPECT_LT(read, 8U * 16U);
}

} // namespace
} // namespace pellucid
