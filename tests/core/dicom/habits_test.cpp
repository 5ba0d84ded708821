// SPDX-License-Identifier: GPL-3.0-or-later
// Series as scanners, anonymisers and converters write them, each with one habit of theirs: how it
// ends is a row of outcomes.md, and voxels that are shown are those that were written.
#include <gtest/gtest.h>
#include <jxl/encode.h>

#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <span>

#include "core/dicom/write_series.h"
#include "core/parse/parse.h"
#include "core/phantom/phantom.h"
#include "core/volume/nrrd.h"
#include "tests/core/dicom/outcome.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using test::DicomWriter;
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

// What a file has to be once its pixels are compressed by somebody: a fragment for each frame.
std::string jpegXl(const std::string &pixels, int rows, int columns, int bits) {
    const std::unique_ptr<JxlEncoder, void (*)(JxlEncoder *)> encoder(JxlEncoderCreate(nullptr),
                                                                      JxlEncoderDestroy);
    JxlBasicInfo info;
    JxlEncoderInitBasicInfo(&info);
    info.xsize = std::uint32_t(columns);
    info.ysize = std::uint32_t(rows);
    info.bits_per_sample = std::uint32_t(bits);
    info.num_color_channels = 1;
    info.uses_original_profile = JXL_TRUE;
    EXPECT_EQ(JxlEncoderSetBasicInfo(encoder.get(), &info), JXL_ENC_SUCCESS);
    JxlColorEncoding color;
    JxlColorEncodingSetToLinearSRGB(&color, JXL_TRUE);
    EXPECT_EQ(JxlEncoderSetColorEncoding(encoder.get(), &color), JXL_ENC_SUCCESS);
    JxlEncoderFrameSettings *const settings = JxlEncoderFrameSettingsCreate(encoder.get(), nullptr);
    EXPECT_EQ(JxlEncoderSetFrameLossless(settings, JXL_TRUE), JXL_ENC_SUCCESS);
    // Samples of fewer bits are given scaled to 16.
    std::vector<std::uint16_t> scaled(std::size_t(rows) * std::size_t(columns));
    std::memcpy(scaled.data(), pixels.data(), pixels.size());
    for (auto &sample : scaled)
        sample = std::uint16_t(std::lround(sample * (65535.0 / (std::exp2(bits) - 1.0))));
    const JxlPixelFormat format{1, JXL_TYPE_UINT16, JXL_LITTLE_ENDIAN, 0};
    EXPECT_EQ(JxlEncoderAddImageFrame(settings, &format, scaled.data(), 2 * scaled.size()),
              JXL_ENC_SUCCESS);
    JxlEncoderCloseInput(encoder.get());
    std::string out(1 << 20, '\0');
    auto *next = reinterpret_cast<std::uint8_t *>(out.data());
    std::size_t left = out.size();
    EXPECT_EQ(JxlEncoderProcessOutput(encoder.get(), &next, &left), JXL_ENC_SUCCESS);
    out.resize(out.size() - left);
    return out;
}

// A frame of run lengths that are all literal: the high bytes, then the low ones.
std::string runLengths(const std::string &pixels, std::size_t missing = 0) {
    const std::size_t plane = pixels.size() / 2;
    std::string body;
    std::vector<std::uint32_t> offsets;
    for (const std::size_t byte : {1U, 0U}) {
        offsets.push_back(std::uint32_t(64 + body.size()));
        for (std::size_t n = 0; n < plane - missing; n += 128) {
            const std::size_t run = std::min<std::size_t>(128, plane - missing - n);
            body += char(run - 1);
            for (std::size_t m = 0; m < run; ++m)
                body += pixels[2 * (n + m) + byte];
        }
        if (body.size() % 2 != 0)
            body += '\0';
    }
    std::string header = DicomWriter::number(std::uint32_t(2));
    for (int n = 0; n < 15; ++n)
        header += DicomWriter::number(n < 2 ? offsets[std::size_t(n)] : std::uint32_t(0));
    return header + body;
}

// Another name for the transfer syntax, as long as the true one.
void relabel(const fs::path &folder, const std::string &from, const std::string &to) {
    ASSERT_EQ(from.size(), to.size());
    for (const auto &entry : fs::directory_iterator(folder)) {
        std::string bytes = test::readText(entry.path());
        const auto at = bytes.find(from);
        ASSERT_NE(at, bytes.npos);
        bytes.replace(at, from.size(), to);
        test::writeText(entry.path(), bytes);
    }
}

// Siemens' header of named values, as short as it can be.
std::string csaHeader(int images, const glm::dvec3 &normal) {
    std::string bytes = "SV10" + std::string("\4\3\2\1", 4) +
                        DicomWriter::number(std::uint32_t(2)) +
                        DicomWriter::number(std::uint32_t(77));
    const auto add = [&](std::string name, const std::vector<std::string> &values) {
        name.resize(64, '\0');
        bytes += name + DicomWriter::number(std::uint32_t(values.size())) +
                 std::string("FD\0\0", 4) + DicomWriter::number(std::uint32_t(4)) +
                 DicomWriter::number(std::uint32_t(values.size())) +
                 DicomWriter::number(std::uint32_t(77));
        for (std::string value : values) {
            const auto size = std::uint32_t(value.size());
            for (int n = 0; n < 4; ++n)
                bytes += DicomWriter::number(n == 2 ? std::uint32_t(77) : size);
            value.resize((value.size() + 3) / 4 * 4, '\0');
            bytes += value;
        }
    };
    add("NumberOfImagesInMosaic", {std::to_string(images)});
    add("SliceNormalVector",
        {std::to_string(normal.x), std::to_string(normal.y), std::to_string(normal.z)});
    return bytes;
}

// Eleven slices of 10 x 8 as a mosaic of 4 x 4 tiles, from the top down.
SeriesKnobs mosaicKnobs() {
    SeriesKnobs knobs;
    knobs.slices = 1;
    knobs.rows = 32;
    knobs.columns = 40;
    knobs.modality = "MR";
    knobs.value = [](int i, int j, int) {
        const int tile = j / 8 * 4 + i / 10;
        return tile < 11 ? 100 * tile + 10 * (j % 8) + i % 10 : 0;
    };
    knobs.change = [](DicomWriter &w, int) {
        w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\M\\ND\\MOSAIC"));
        w.putNumbers({0x0018, 0x0088}, {3.5});
        w.put({0x0029, 0x0010}, "LO", std::string("SIEMENS CSA HEADER"));
        w.put({0x0029, 0x1010}, "OB", csaHeader(11, {0.0, 0.0, -1.0}));
    };
    return knobs;
}

// An Enhanced CT with a frame for each slice.
DicomWriter enhanced(const SeriesKnobs &knobs) {
    DicomWriter w = test::sliceOf(knobs, 0);
    w.put({0x0008, 0x0016}, "UI", std::string("1.2.840.10008.5.1.4.1.1.2.1"));
    w.put({0x0028, 0x0008}, "IS", std::to_string(knobs.slices));
    std::vector<DicomWriter> frames;
    std::string pixels;
    for (int k = 0; k < knobs.slices; ++k) {
        const DicomWriter slice = test::sliceOf(knobs, k);
        pixels += slice.text(DicomWriter::pixelData);
        DicomWriter position, group;
        position.put({0x0020, 0x0032}, "DS", slice.text({0x0020, 0x0032}));
        group.putSequence({0x0020, 0x9113}, {position});
        frames.push_back(group);
    }
    w.remove({0x0020, 0x0032});
    w.putSequence({0x5200, 0x9230}, frames);
    w.put(DicomWriter::pixelData, "OW", pixels);
    return w;
}

volume::Volume smallHead() {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{32, 30, 5},
                                                      .spacingMm = glm::dvec3(6.1, 6.7, 30.0)}));
}

using Write = std::function<void(const fs::path &folder)>;

std::map<std::string, Write> habits() {
    std::map<std::string, Write> all;
    const auto add = [&](const std::string &name, const std::function<void(SeriesKnobs &)> &turn,
                         const Form &form = Form()) {
        all[name] = [turn, form](const fs::path &folder) {
            SeriesKnobs knobs;
            turn(knobs);
            test::writeSeries(folder, knobs, form);
        };
    };
    add("each slice its own frame of reference", [](auto &k) { k.ownFrames = true; });
    add("each slice its own study", [](auto &k) { k.ownStudies = true; });
    add("one instance UID in all slices", [](auto &k) { k.slices = 93, k.oneInstance = true; });
    all["an Enhanced file and its slices under one instance UID"] = [](const fs::path &folder) {
        SeriesKnobs knobs;
        knobs.slices = 7;
        knobs.oneInstance = true;
        test::writeSeries(folder, knobs);
        enhanced(knobs).write(folder / "enhanced.dcm");
    };
    add("positions with one decimal",
        [](auto &k) { k.slices = 114, k.stepMm = 1.25, k.positionDigit = 0.1; });
    add("positions with one decimal, a slice missing",
        [](auto &k) { k.slices = 114, k.stepMm = 1.25, k.positionDigit = 0.1, k.missing = {50}; });
    add("two slices missing side by side", [](auto &k) { k.slices = 30, k.missing = {11, 12}; });
    add("axes jitter by 1e-4", [](auto &k) { k.axisJitterRad = 1e-4; });
    add("axes jitter by 1e-3", [](auto &k) { k.slices = 30, k.axisJitterRad = 1e-3; });
    add("pixel spacings 3.2000 and 3.2002", [](auto &k) {
        k.pixelMm = {3.2, 3.2}, k.pixelJitter = 6e-5;
    });
    add("a Siemens mosaic", [](auto &k) { k = mosaicKnobs(); });
    add("a Siemens mosaic that counts its images in 0019,100A", [](auto &k) {
        k = mosaicKnobs();
        k.change = [old = k.change](DicomWriter &w, int n) {
            old(w, n);
            w.remove({0x0029, 0x1010});
            w.put({0x0019, 0x0010}, "LO", std::string("SIEMENS MR HEADER"));
            w.putShort({0x0019, 0x100A}, 11);
        };
    });
    const auto fragments = [](const std::function<std::string(const std::string &)> &code) {
        return [code](SeriesKnobs &k) {
            k.change = [code](DicomWriter &w, int) {
                w.putFragments({code(w.text(DicomWriter::pixelData))});
                w.remove(DicomWriter::pixelData);
            };
        };
    };
    const auto xl = [](int bits) {
        return [bits](const std::string &pixels) { return jpegXl(pixels, 8, 10, bits); };
    };
    add("JPEG XL", fragments(xl(16)), {.syntax = "1.2.840.10008.1.2.4.110"});
    add("JPEG XL of 12 bits",
        [=](SeriesKnobs &k) {
            fragments(xl(12))(k);
            k.change = [old = k.change](DicomWriter &w, int n) {
                old(w, n);
                w.putShort({0x0028, 0x0101}, 12);
                w.putShort({0x0028, 0x0102}, 11);
                w.putShort({0x0028, 0x0103}, 0);
            };
        },
        {.syntax = "1.2.840.10008.1.2.4.112"});
    add("JPEG XL that is cut off", fragments([=](const std::string &pixels) {
            const std::string whole = xl(16)(pixels);
            return whole.substr(0, whole.size() / 2);
        }),
        {.syntax = "1.2.840.10008.1.2.4.110"});
    add("an unknown syntax", fragments(xl(16)), {.syntax = "1.2.840.10008.1.2.4.999"});
    add("run lengths", fragments([](const auto &p) { return runLengths(p); }),
        {.syntax = "1.2.840.10008.1.2.5"});
    add("run lengths without an end", fragments([](const auto &p) { return runLengths(p); }),
        {.syntax = "1.2.840.10008.1.2.5", .hasDelimiter = false});
    add("run lengths of too few bytes", fragments([](const auto &p) { return runLengths(p, 3); }),
        {.syntax = "1.2.840.10008.1.2.5"});
    add("plain pixels under a compressed syntax", [](auto &) {},
        {.syntax = "1.2.840.10008.1.2.4.90"});
    add("implicit data labelled explicit", [](auto &) {}, {.isImplicit = true});
    add("three samples of MONOCHROME2", [](auto &k) {
        k.change = [](DicomWriter &w, int) { w.putShort({0x0028, 0x0002}, 3); };
    });
    add("a label map", [](auto &k) {
        k.change = [](DicomWriter &w, int) {
            w.put({0x0008, 0x0016}, "UI", std::string("1.2.840.10008.5.1.4.1.1.66.7"));
        };
    });
    add("an image of 20000 columns", [](auto &k) { k.slices = 1, k.rows = 2, k.columns = 20000; });
    all["a bare JPEG 2000 stream of defined length"] = [](const fs::path &folder) {
        dicom::writeCtSeries(folder, smallHead(), {}, dicom::TransferSyntax::jpeg2000);
        for (const auto &entry : fs::directory_iterator(folder)) {
            // The one fragment is taken out of its item.
            std::string bytes = test::readText(entry.path());
            const auto at = bytes.find(std::string("\xE0\x7F\x10\x00OB\0\0\xFF\xFF\xFF\xFF", 12));
            ASSERT_NE(at, bytes.npos);
            const auto begin = bytes.find("\xFF\x4F\xFF\x51", at);
            const std::string stream = bytes.substr(begin, bytes.size() - 8 - begin);
            bytes = bytes.substr(0, at + 8) + DicomWriter::number(std::uint32_t(stream.size())) +
                    stream;
            test::writeText(entry.path(), bytes);
        }
    };
    const auto coded = [&](const std::string &name, dicom::TransferSyntax syntax,
                           const std::function<void(const fs::path &)> &then) {
        all[name] = [syntax, then](const fs::path &folder) {
            dicom::writeCtSeries(folder, smallHead(), {}, syntax);
            then(folder);
        };
    };
    coded("lossless JPEG labelled baseline", dicom::TransferSyntax::jpegLossless,
          [](const fs::path &folder) {
              relabel(folder, "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.50");
          });
    const auto rows = [](int value) {
        return [value](const fs::path &folder) {
            relabel(folder, std::string("\x28\0\x10\0US\2\0\x1E\0", 10),
                    std::string("\x28\0\x10\0US\2\0", 8) +
                        DicomWriter::number(std::uint16_t(value)));
        };
    };
    coded("JPEG smaller than the header says", dicom::TransferSyntax::jpegLossless, rows(31));
    coded("JPEG larger than the header says", dicom::TransferSyntax::jpegLossless, rows(29));
    coded("JPEG-LS larger than the header says", dicom::TransferSyntax::jpegLs, rows(29));
    coded("JPEG 2000 larger than the header says", dicom::TransferSyntax::jpeg2000, rows(29));
    coded("lossless JPEG of more bits than BitsStored", dicom::TransferSyntax::jpegLossless,
          [](const fs::path &folder) {
              relabel(folder, std::string("\x28\0\1\1US\2\0\x10\0", 10),
                      std::string("\x28\0\1\1US\2\0\x0A\0", 10));
              relabel(folder, std::string("\x28\0\2\1US\2\0\x0F\0", 10),
                      std::string("\x28\0\2\1US\2\0\x09\0", 10));
          });
    return all;
}

} // namespace

TEST(Habits, EndAsTheTableSays) {
    auto expected = test::outcomesTable();
    std::erase_if(expected, [](const auto &row) { return !row.first.starts_with("habit: "); });
    std::size_t seen = 0;
    for (const auto &[name, write] : habits()) {
        const test::TemporaryFolder folder;
        const std::string row = "habit: " + name;
        write(folder / row);
        EXPECT_EQ(test::outcomeOf(folder / row), expected[row]);
        ++seen;
    }
    EXPECT_EQ(seen, expected.size());
}

// What is shown of a series is what was written.
TEST(Habits, VoxelsAreThoseThatWereWritten) {
    const auto whole = [](const SeriesKnobs &knobs, const Form &form = Form()) {
        const test::TemporaryFolder folder;
        test::writeSeries(folder.path(), knobs, form);
        const volume::Volume volume = loaded(folder.path());
        ASSERT_EQ(volume.lattice().size(),
                  (volume::GridSize{knobs.columns, knobs.rows, knobs.slices}));
        EXPECT_NEAR(volume.lattice().sliceDistanceMm(), knobs.stepMm,
                    0.1 / (knobs.slices - 1)); // of one decimal
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

// Fewer bits come scaled out of JPEG XL's decoder: each of their values is that which was coded.
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

TEST(Habits, AHoleIsLeftOutOrFilledAsIsAsked) {
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
    // The corner of the whole lies half of what it is larger outside the corner of a tile. Slices
    // are stored from the top down; a stack goes along the normal, up.
    const glm::dvec3 top(-5.0 + 15.0, 7.0 + 12.0, -31.7);
    const glm::dvec3 bottom = top + glm::dvec3(0.0, 0.0, -35.0);
    EXPECT_LT(glm::distance(lattice.origin().mm, bottom), 1e-9);
    EXPECT_LT(glm::distance(lattice.step(2), glm::dvec3(0.0, 0.0, 3.5)), 1e-9);
    expectVoxels(volume, SeriesKnobs(), [](int k) { return 10 - k; });
}

TEST(Habits, WindowsAreThoseOfTheMiddleSlice) {
    SeriesKnobs knobs{.slices = 9, .modality = "MR"};
    knobs.window = [](int k) {
        return k == 4 ? glm::dvec2(617.0, 1234.0) : glm::dvec2(22.0, 11.0);
    };
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), knobs);
    const auto windows = loaded(folder.path()).notes().windows;
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_EQ(windows[0].center, 617.0);
}

// What is opened where several things lie together.
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

TEST(Habits, WhatIsUnusuallyLargeIsOpenedWhenItIsAskedFor) {
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), {.slices = 1, .rows = 2, .columns = 20000});
    const auto refused = dicom::scan({folder.path()});
    ASSERT_EQ(refused.skipped.size(), 1U);
    EXPECT_TRUE(refused.skipped[0].isHuge);
    EXPECT_TRUE(refused.empty());
    const auto taken = dicom::scan({folder.path()}, {}, {.takesHuge = true});
    EXPECT_TRUE(taken.skipped.empty());
    EXPECT_EQ(dicom::defaultSelection(taken).volume->geometry.lattice.size().i, 20000);
}

// Ten times the frames take ten times as long, twice that beyond the caches; not a hundred times.
TEST(Habits, HeadersTakeTimeInProportionToTheirFrames) {
    const auto seconds = [](int frames) {
        SeriesKnobs knobs{.slices = 1, .rows = 1, .columns = 1};
        DicomWriter w = test::sliceOf(knobs, 0);
        w.put({0x0028, 0x0008}, "IS", std::to_string(frames));
        DicomWriter position, group;
        position.putNumbers({0x0020, 0x0032}, {0.0, 0.0, 1.0});
        group.putSequence({0x0020, 0x9113}, {position});
        w.putSequence({0x5200, 0x9230}, std::vector<DicomWriter>(std::size_t(frames), group));
        w.put(DicomWriter::pixelData, "OW", std::string(std::size_t(2 * frames), '\0'));
        const std::string file = w.file(Form());
        double fastest = 1e9;
        for (int round = 0; round < 3; ++round) {
            const std::clock_t start = std::clock(); // of this process, whatever runs beside it
            const auto header = parse::parseHeader(std::as_bytes(std::span(file)));
            fastest = std::min(fastest, double(std::clock() - start));
            EXPECT_EQ(header.frames.size(), std::size_t(frames));
        }
        return fastest;
    };
    EXPECT_LT(seconds(20000), 40.0 * seconds(2000));
}

} // namespace pellucid
