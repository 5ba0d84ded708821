// SPDX-License-Identifier: GPL-3.0-or-later
// The voxels and notes of series with the habits of scanners, anonymisers and converters: a loaded
// series equals the written one.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dcmtk/codecs.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/volume/nrrd.h"
#include "tests/core/dicom/habit_frames.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using test::DicomWriter;
using test::jpegXl;
using test::mosaicKnobs;
using test::runLengths;
using test::SeriesKnobs;
using Form = DicomWriter::Form;

volume::Volume loaded(const fs::path &path, dicom::Holes holes = dicom::Holes::split) {
    const auto catalogue = dicom::scan({path});
    return dicom::loadVolume(*dicom::defaultSelection(catalogue, holes).volume).volume;
}

// Slice k of the volume is slice `of(k)` of the series.
void expectVoxels(
    const volume::Volume &volume, const SeriesKnobs &knobs,
    const std::function<int(int)> &of = [](int k) { return k; }) {
    const auto size = volume.lattice().size();
    std::size_t different = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                different += volume.value({i, j, k}) != double(knobs.value(i, j, of(k))) ? 1 : 0;
    EXPECT_EQ(different, 0U);
}

} // namespace

// A loaded series has the voxels that were written.
TEST(Habits, VoxelsAreThoseThatWereWritten) {
    const auto whole = [](const SeriesKnobs &knobs, const Form &form = Form()) {
        const test::TemporaryFolder folder;
        test::writeSeries(folder.path(), knobs, form);
        const volume::Volume volume = loaded(folder.path());
        ASSERT_EQ(volume.lattice().size(),
                  (volume::GridSize{knobs.columns, knobs.rows, knobs.slices}));
        EXPECT_NEAR(volume.lattice().sliceDistanceMm(), knobs.stepMm,
                    0.1 / (knobs.slices - 1)); // positions have one decimal
        expectVoxels(volume, knobs);
    };
    whole({.ownFrames = true});
    whole({.ownStudies = true});
    whole({.oneInstance = true});
    whole({.slices = 60, .stepMm = 1.33, .positionDigit = 0.1});
    whole({.axisJitterRad = 1e-3});
    whole({.pixelMm = {3.2, 3.2}, .pixelJitter = 6e-5});
    whole({}, {.isImplicit = true});
    whole({}, {.syntax = "1.2.840.10008.1.2.4.90"});
    SeriesKnobs lossless;
    lossless.change = [](DicomWriter &w, int) {
        w.putFragments({jpegXl(w.text(DicomWriter::pixelData), 8, 10, 16)});
        w.remove(DicomWriter::pixelData);
    };
    whole(lossless, {.syntax = "1.2.840.10008.1.2.4.110"});
    lossless.change = [](DicomWriter &w, int) {
        w.putFragments({runLengths(w.text(DicomWriter::pixelData))});
        w.remove(DicomWriter::pixelData);
    };
    whole(lossless, {.syntax = "1.2.840.10008.1.2.5", .hasDelimiter = false});
}

// JPEG XL's decoder scales samples of fewer bits: every value is restored exactly.
TEST(Habits, JpegXlGivesEveryValueOfFewerBits) {
    for (const int bits : {8, 10, 12, 15, 16}) {
        SeriesKnobs knobs;
        knobs.slices = 1;
        knobs.rows = 64;
        knobs.columns = 64;
        knobs.modality = "MR"; // all 16 bits
        knobs.value = [bits](int i, int j, int) {
            return int((std::int64_t(j * 64 + i) * ((1 << bits) - 1)) / 4095);
        };
        knobs.change = [bits](DicomWriter &w, int) {
            w.putFragments({jpegXl(w.text(DicomWriter::pixelData), 64, 64, bits)});
            w.remove(DicomWriter::pixelData);
            w.putShort({0x0028, 0x0101}, bits);
            w.putShort({0x0028, 0x0102}, bits - 1);
            w.putShort({0x0028, 0x0103}, 0);
        };
        const test::TemporaryFolder folder;
        test::writeSeries(folder.path(), knobs, {.syntax = "1.2.840.10008.1.2.4.110"});
        expectVoxels(loaded(folder.path()), knobs);
    }
}

// Compressed samples are those of the same pixels uncompressed, whatever lies above or below them.
// A stream of 12 bits has none below, even where the header states a high bit of 15.
TEST(Habits, CompressedSamplesAreThoseOfThePlainOnes) {
    dcmtk::prepareDcmtk();
    struct Words {
        int highBit, isSigned;
        std::function<int(int value)> word;
        std::vector<E_TransferSyntax> syntaxes;
    };
    const auto asIs = [](int value) { return value & 0xFFF; };
    // The lossless JPEG of this writer is as wide as the words; its JPEG-LS as the samples.
    const std::vector<E_TransferSyntax> wide{EXS_LittleEndianExplicit, EXS_JPEGProcess14SV1,
                                             EXS_RLELossless};
    for (const Words &w :
         {Words{15, 0, asIs, {EXS_JPEGLSLossless}},
          Words{15, 0, [](int v) { return v << 4; }, wide}, Words{11, 1, asIs, wide},
          Words{11, 0, [](int v) { return v | 0x5000; }, wide}})
        for (const E_TransferSyntax syntax : w.syntaxes) {
            SeriesKnobs knobs;
            knobs.modality = "MR";
            knobs.value = [&](int i, int j, int k) {
                return (w.isSigned != 0 ? -300 : 3000) + 100 * k + 10 * j + i;
            };
            SeriesKnobs written = knobs;
            written.value = [&](int i, int j, int k) { return w.word(knobs.value(i, j, k)); };
            const bool isShifted = w.word(1) == 16;
            written.change = [&](DicomWriter &file, int) {
                file.putShort({0x0028, 0x0101}, 12);
                file.putShort({0x0028, 0x0102}, isShifted ? 15 : 11);
                file.putShort({0x0028, 0x0103}, w.isSigned);
            };
            const test::TemporaryFolder folder;
            test::writeSeries(folder.path(), written);
            for (const auto &entry : fs::directory_iterator(folder.path())) {
                DcmFileFormat file;
                ASSERT_TRUE(file.loadFile(entry.path().c_str()).good());
                ASSERT_TRUE(file.loadAllDataIntoMemory().good());
                DcmDataset &dataset = *file.getDataset();
                ASSERT_TRUE(dataset.chooseRepresentation(syntax, nullptr).good());
                ASSERT_TRUE(dataset.putAndInsertUint16(DCM_HighBit, Uint16(w.highBit)).good());
                ASSERT_TRUE(file.saveFile(entry.path().c_str(), syntax).good());
            }
            SCOPED_TRACE(testing::Message() << w.highBit << ' ' << w.isSigned << ' ' << w.word(1)
                                            << ' ' << DcmXfer(syntax).getXferName());
            expectVoxels(loaded(folder.path()), knobs);
        }
}

TEST(Habits, AGapIsLeftOutOrFilledOnRequest) {
    const SeriesKnobs knobs{.slices = 30, .missing = {11, 12}};
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), knobs);
    const volume::Volume run = loaded(folder.path());
    ASSERT_EQ(run.lattice().size().k, 17);
    expectVoxels(run, knobs, [](int k) { return k + 13; });
    EXPECT_TRUE(run.notes().filled.empty());
    const volume::Volume whole = loaded(folder.path(), dicom::Holes::fill);
    ASSERT_EQ(whole.lattice().size().k, 30);
    EXPECT_EQ(whole.notes().filled, (std::vector<volume::SliceRange>{{11, 12}}));
    expectVoxels(whole, knobs); // the values of the knobs are linear along the stack
}

TEST(Habits, AMosaicIsItsSlicesAtTheirPlaces) {
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), mosaicKnobs());
    const volume::Volume volume = loaded(folder.path());
    const volume::Lattice &lattice = volume.lattice();
    ASSERT_EQ(lattice.size(), (volume::GridSize{10, 8, 11}));
    // The mosaic is larger than a tile: its corner is half the difference outside the tile's
    // corner. Slices are stored from the top down; the stack goes up, along the normal.
    const glm::dvec3 top(-5.0 + 15.0, 7.0 + 12.0, -31.7);
    const glm::dvec3 bottom = top + glm::dvec3(0.0, 0.0, -35.0);
    EXPECT_LT(glm::distance(lattice.origin().mm, bottom), 1e-9);
    EXPECT_LT(glm::distance(lattice.step(2), glm::dvec3(0.0, 0.0, 3.5)), 1e-9);
    expectVoxels(volume, SeriesKnobs(), [](int k) { return 10 - k; });
}

// The first slice is often noise. Where values have no unit, windows that differ are not used at
// all.
TEST(Habits, WindowsInHuAreThoseOfTheMiddleSlice) {
    SeriesKnobs knobs{.slices = 9};
    knobs.window = [](int k) {
        return k == 4 ? glm::dvec2(617.0, 1234.0) : glm::dvec2(22.0, 11.0);
    };
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), knobs);
    const auto windows = loaded(folder.path()).notes().windows;
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_EQ(windows[0].center, 617.0);
}

// The volume that is opened by default from a folder with several.
TEST(Habits, AStackComesBeforeALargeImageAndALabelFile) {
    const test::TemporaryFolder folder;
    SeriesKnobs stack{.slices = 4};
    test::writeSeries(folder / "ct", stack);
    SeriesKnobs scout{.slices = 1, .rows = 600, .columns = 700};
    scout.change = [](DicomWriter &w, int) {
        w.put({0x0020, 0x000E}, "UI", std::string("1.2.3.4"));
        w.put({0x0008, 0x0018}, "UI", std::string("1.2.3.4.5"));
    };
    test::writeSeries(folder / "scout", scout);
    volume::writeNrrd(folder / "labels.nrrd",
                      volume::Volume(volume::Lattice::centred({40, 40, 40}, {1.0, 1.0, 1.0}),
                                     std::vector<std::int16_t>(64000, 1), volume::ValueUnit::none));
    expectVoxels(loaded(folder.path()), stack);
}

} // namespace pellucid
