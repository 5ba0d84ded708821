// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string_view>

#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/dicom/write_series.h"
#include "core/parse/parse.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/little_memory.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;

volume::Volume tiltedHead(int slices = 7) {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{33, 30, slices},
                                                      .spacingMm = glm::dvec3(6.1, 6.7, 30.0),
                                                      .tiltRad = 0.3}));
}

// As `dcmodify` does.
bool modify(const std::string &changes, const std::vector<fs::path> &files) {
    std::string command = "dcmodify -nb " + changes;
    for (const fs::path &file : files)
        command += " '" + file.string() + "'";
    return std::system((command + " > /dev/null").c_str()) == 0;
}

dicom::LoadedVolume loadDefault(const fs::path &path) {
    const auto catalogue = dicom::scan({path});
    return dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
}

void expectSameSamples(const volume::Volume &a, const volume::Volume &b) {
    ASSERT_EQ(a.lattice().size(), b.lattice().size());
    a.visit([&](auto x) {
        b.visit([&](auto y) {
            std::size_t different = 0;
            for (std::size_t n = 0; n < x.size(); ++n)
                different += double(x[n]) != double(y[n]) ? 1 : 0;
            EXPECT_EQ(different, 0U);
        });
    });
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, SamplesAndGeometryComeBack) {
    const test::TemporaryFolder folder;
    const volume::Volume head = tiltedHead();
    dicom::writeCtSeries(folder.path(), head, {.patientName = "Test^Patient", .patientId = "1"},
                         dicom::transferSyntaxFromName(GetParam()));
    const auto loaded = loadDefault(folder.path());
    EXPECT_TRUE(loaded.skipped.empty());
    EXPECT_EQ(loaded.volume.unit(), volume::ValueUnit::hounsfield);
    expectSameSamples(loaded.volume, head);
    // Positions are written with at least ten digits.
    const auto &a = loaded.volume.lattice(), &b = head.lattice();
    EXPECT_LT(glm::distance(a.origin().mm, b.origin().mm), 1e-6);
    for (int d = 0; d < 3; ++d)
        EXPECT_LT(glm::distance(a.step(d), b.step(d)), 1e-6);
    EXPECT_NEAR(a.shearRad(), 0.3, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(TransferSyntaxes, RoundTrip,
                         testing::ValuesIn(dicom::transferSyntaxNames()),
                         [](const auto &parameter) {
                             std::string name = parameter.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Load, ATruncatedSliceIsNamedAndTheRestIsResampledAcrossTheHole) {
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
    bool told = false;
    for (const task::Reason &warning : loaded.volume.notes().warnings)
        told = told || warning.is(task::because::missingSlices);
    EXPECT_TRUE(told);
}

TEST(Decode, SizesThatTheFileCannotHoldAreRefusedBeforeMemoryIsAskedFor) {
    for (const auto syntax : {dicom::TransferSyntax::explicitLittle, dicom::TransferSyntax::rle,
                              dicom::TransferSyntax::jpeg2000, dicom::TransferSyntax::jpegLs}) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), tiltedHead(), {}, syntax);
        auto bytes = test::readBytes(folder / "IM0001.dcm");
        // Rows (0028,0010) and Columns (0028,0011), US, two bytes each, become 65535.
        for (const char element : {'\x10', '\x11'}) {
            const std::string wanted{'\x28', '\0', element, '\0', 'U', 'S', '\x02', '\0'};
            const auto *text = reinterpret_cast<const char *>(bytes.data());
            const auto at = std::string_view(text, bytes.size()).find(wanted);
            ASSERT_NE(at, std::string_view::npos);
            bytes[at + 8] = bytes[at + 9] = std::byte(0xFF);
        }
#ifndef PELLUCID_SANITIZED // which reserve terabytes
        const test::LittleMemory little(256);
#endif
        try {
            parse::decodeImage(bytes);
            ADD_FAILURE() << int(syntax);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.reason().english(), "the pixels are truncated") << int(syntax);
        }
    }
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

TEST(Write, CancellingLeavesNoFile) {
    const test::TemporaryFolder folder;
    std::stop_source source;
    const task::Progress progress(source.get_token(), [&](double fraction) {
        if (fraction > 0.3)
            source.request_stop();
    });
    EXPECT_THROW(dicom::writeCtSeries(folder / "series", tiltedHead(), {},
                                      dicom::TransferSyntax::rle, progress),
                 task::Cancelled);
    EXPECT_FALSE(fs::exists(folder / "series"));
}

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

TEST(Scan, PathsThatCannotBeUsedAreErrorsWithTheirName) {
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

// Values of a slice follow its own rescale: one for all of them shows stripes.
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

// Half of a number, or none, would be other values without a word.
TEST(Load, ARescaleThatIsNoNumberCostsItsSlice) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    const auto modified = [&](const char *file, const std::string &change) {
        return std::system(
            ("dcmodify -nb -m '" + change + "' '" + (folder / file).string() + "' > /dev/null")
                .c_str());
    };
    const std::vector<std::string> changes{"RescaleSlope=2,5", "RescaleSlope=nan",
                                           "RescaleIntercept=abc", "RescaleSlope=1e300"};
    for (std::size_t n = 0; n < changes.size(); ++n)
        ASSERT_EQ(modified(("IM000" + std::to_string(n + 1) + ".dcm").c_str(), changes[n]), 0);
    ASSERT_EQ(modified("IM0006.dcm", "RescaleSlope=+1.0 "), 0);
    const auto catalogue = dicom::scan({folder.path()});
    ASSERT_EQ(catalogue.skipped.size(), changes.size());
    for (const auto &skipped : catalogue.skipped)
        EXPECT_EQ(skipped.reason.english(),
                  "has a rescale slope or intercept that gives no values");
    // Blanks are no value; some write a slope of 0 and mean nothing by it, which is said.
    ASSERT_EQ(modified("IM0005.dcm", "RescaleIntercept=  "), 0);
    ASSERT_EQ(modified("IM0007.dcm", "RescaleSlope=0"), 0);
    const auto loaded = loadDefault(folder.path()).volume;
    EXPECT_EQ(loaded.lattice().size().k, 3);
    EXPECT_THAT(loaded.notes().warnings, testing::Contains(task::because::zeroSlopes(1)));
}

// Codes that a rescale makes one number in 24 bits are refused; those that it makes nearly so are
// shown with a warning.
TEST(Load, ARescaleThatLeavesNoDifferencesIsNamed) {
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

// As PS3.3, C.12.1.1.2 names them, with the examples of PS3.5, H.3.1 and H.3.2; a text that is
// damaged keeps no other from being read.
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

TEST(Scan, WhetherValuesAreSignedIsNotGuessed) {
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

// Through the file, the decoder and the grouping.
TEST(Scan, SamplesOfAVolumeFileAreNobodysLoss) {
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

TEST(Scan, AnotherSpaceIsAnotherVolume) {
    const test::TemporaryFolder folder;
    dicom::writeCtSeries(folder.path(), tiltedHead(), {}, dicom::TransferSyntax::explicitLittle);
    ASSERT_TRUE(modify("-m FrameOfReferenceUID=1.2.3",
                       {folder / "IM0001.dcm", folder / "IM0002.dcm", folder / "IM0003.dcm"}));
    const auto all = dicom::selections(dicom::scan({folder.path()}));
    EXPECT_EQ(all.size(), 2U);
}

// Of 20 images 18 are alone in theirs, which is just enough to ignore it; of the 19 that are left
// 17 are, which is not.
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

// An index that leads out of its folder, in words or by a link.
TEST(Scan, ADirectoryLeadsNowhereElse) {
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
    EXPECT_EQ(catalogue.skipped[0].reason.english(), "lists a file outside its folder");
}

TEST(Load, MorePixelsThanTheHeaderSaysAreMentioned) {
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
    // Pixel Data (7FE0,0010), OW, is the last element: a row more.
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

// How much of the files of a folder is in memory; read or not, without reading it.
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

// Shares and CDs are slow: the pixels stay where they are until a series is opened.
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
