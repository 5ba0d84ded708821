// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/task/error.h"
#include "core/volume/statistics.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;

struct Opened {
    dicom::Catalogue catalogue;
    volume::Volume volume;
};

Opened open(const std::string &folder) {
    Opened opened{dicom::scan({test::testData() / folder}), {}};
    opened.volume = dicom::loadVolume(*dicom::defaultSelection(opened.catalogue).volume).volume;
    return opened;
}

double tiltDeg(const volume::Lattice &lattice) {
    return lattice.shearRad() * 180.0 / std::numbers::pi;
}

TEST(RealSeries, TheChestCt) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto chest = open("ct_chest_philips_64");
    const auto &lattice = chest.volume.lattice();
    EXPECT_EQ(lattice.size(), (volume::GridSize{512, 512, 64}));
    EXPECT_NEAR(lattice.spacingMm(0), 0.842, 5e-4);
    EXPECT_NEAR(lattice.sliceDistanceMm(), 5.0, 1e-6);
    EXPECT_LT(tiltDeg(lattice), 1e-3);
    EXPECT_EQ(chest.volume.unit(), volume::ValueUnit::hounsfield);
    EXPECT_TRUE(chest.volume.notes().warnings.empty());
    ASSERT_EQ(chest.volume.notes().windows.size(), 1U); // two equal values
    EXPECT_EQ(chest.volume.notes().windows[0].center, 60.0);
    // 12 unsigned bits with intercept -1024.
    const auto s = volume::statistics(chest.volume);
    EXPECT_EQ(s.minimum, -1024.0);
    EXPECT_GT(s.maximum, 1000.0);
    EXPECT_LE(s.maximum, 3071.0);
    // The two files that are not images are listed.
    EXPECT_EQ(chest.catalogue.skipped.size(), 2U);
}

TEST(RealSeries, TheTiltedHeadIsResampledAlongItsStackAndKeepsItsTilt) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto head = open("ct_head_tilt_ge_28");
    const auto &lattice = head.volume.lattice();
    EXPECT_EQ(lattice.size(), (volume::GridSize{512, 512, 37})); // 144.1 mm in steps of 4.002
    EXPECT_NEAR(lattice.spacingMm(0), 0.488, 5e-4);
    EXPECT_NEAR(lattice.sliceDistanceMm(), 4.002, 5e-4);
    EXPECT_NEAR(tiltDeg(lattice), 18.5, 0.01);
    EXPECT_LT(std::abs(lattice.step(2).y), 1e-6); // the table moves along z
    const auto &warnings = head.volume.notes().warnings;
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_NE(warnings[0].english().find("14.dcm"), std::string::npos);
    EXPECT_NE(warnings[0].english().find("15.dcm"), std::string::npos);
    EXPECT_NE(warnings[1].english().find("18.5"), std::string::npos);
    // Padding of -1500 is not tissue: the lowest value is air.
    const auto s = volume::statistics(head.volume);
    EXPECT_GE(s.minimum, -1100.0);
    EXPECT_GT(s.maximum, 1500.0);
    // The first thirteen slices lie where the frames do: their samples are untouched.
    const auto first =
        decoding::Decoder::shared().image(test::testData() / "ct_head_tilt_ge_28/01.dcm");
    EXPECT_EQ(head.volume.value({256, 256, 0}),
              double(std::int16_t(first.samples[256 * 512 + 256])));
}

TEST(RealSeries, TheSagittalMr) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto mr = open("mr_t1_sag_siemens_35");
    const auto &lattice = mr.volume.lattice();
    EXPECT_EQ(lattice.size(), (volume::GridSize{256, 256, 35}));
    EXPECT_NEAR(lattice.spacingMm(0), 1.016, 5e-4);
    EXPECT_NEAR(lattice.sliceDistanceMm(), 4.8, 1e-3);
    EXPECT_EQ(mr.volume.unit(), volume::ValueUnit::none);
    // Rows run to posterior, columns to inferior.
    EXPECT_NEAR(lattice.step(0).y, lattice.spacingMm(0), 1e-6);
    EXPECT_NEAR(lattice.step(1).z, -lattice.spacingMm(1), 1e-6);
}

fs::path syntaxFile(const char *uid) {
    for (const auto &entry : fs::directory_iterator(test::testData() / "nasty_ts_ctimage"))
        if (entry.path().filename().string().find(std::string("_") + uid + ".dcm") !=
            std::string::npos)
            return entry.path();
    return {};
}

decoding::DecodedImage decoded(const fs::path &path) {
    const auto file = decoding::Decoder::shared().image(path);
    return {file.header, {file.samples.begin(), file.samples.end()}};
}

TEST(TransferSyntaxes, LosslessOnesDecodeToTheSamePixels) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto plain = decoded(test::testData() / "nasty_ts_ctimage/CTImage.dcm");
    ASSERT_EQ(plain.samples.size(), 512U * 512U);
    ASSERT_TRUE(plain.header.isSigned());
    for (const char *uid :
         {"1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2", "1.2.840.10008.1.2.1.99",
          "1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70",
          "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"})
        EXPECT_EQ(decoded(syntaxFile(uid)).samples, plain.samples) << uid;
}

double rescaledValue(const decoding::DecodedImage &image, std::size_t n) {
    const double stored =
        image.header.isSigned() ? double(std::int16_t(image.samples[n])) : double(image.samples[n]);
    return image.header.frames[0].rescale.slope * stored + image.header.frames[0].rescale.intercept;
}

// Lossy files are compared with the original in HU, inside the patient. The 12-bit files were
// rescaled by slope 2, so a step of theirs is 2 HU; JPEG at these rates keeps the root mean square
// below some 10 HU.
TEST(TransferSyntaxes, LossyOnesStayWithinTheirBound) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto plain = decoded(test::testData() / "nasty_ts_ctimage/CTImage.dcm");
    const std::pair<const char *, double> bounds[] = {{"1.2.840.10008.1.2.4.91", 12.0},
                                                      {"1.2.840.10008.1.2.4.81", 3.0},
                                                      {"1.2.840.10008.1.2.4.51", 12.0},
                                                      {"1.2.840.10008.1.2.4.53", 12.0},
                                                      {"1.2.840.10008.1.2.4.55", 12.0}};
    for (const auto &[uid, bound] : bounds) {
        const auto image = decoded(syntaxFile(uid));
        ASSERT_EQ(image.samples.size(), plain.samples.size()) << uid;
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t n = 0; n < plain.samples.size(); ++n) {
            const double truth = rescaledValue(plain, n);
            if (truth < -950.0 || truth > 2000.0)
                continue;
            const double difference = rescaledValue(image, n) - truth;
            sum += difference * difference;
            ++count;
        }
        EXPECT_LT(std::sqrt(sum / double(count)), bound) << uid;
    }
    // The 8-bit one was windowed; it still shows the same picture.
    const auto eight = decoded(syntaxFile("1.2.840.10008.1.2.4.50"));
    double xy = 0, xx = 0, yy = 0, mx = 0, my = 0;
    const auto count = double(plain.samples.size());
    for (std::size_t n = 0; n < plain.samples.size(); ++n) {
        mx += rescaledValue(plain, n) / count;
        my += eight.samples[n] / count;
    }
    for (std::size_t n = 0; n < plain.samples.size(); ++n) {
        const double x = rescaledValue(plain, n) - mx, y = eight.samples[n] - my;
        xy += x * y;
        xx += x * x;
        yy += y * y;
    }
    EXPECT_GT(xy / std::sqrt(xx * yy), 0.9);
}

TEST(Nasty, AMissingSliceIsInterpolatedAndNamed) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto ct = open("nasty_ct_missing_slice_ge_4");
    EXPECT_EQ(ct.volume.lattice().size().k, 5);
    EXPECT_NEAR(ct.volume.lattice().sliceDistanceMm(), 5.0, 1e-3);
    ASSERT_EQ(ct.volume.notes().warnings.size(), 1U);
    EXPECT_NE(ct.volume.notes().warnings[0].english().find("IM-0001-0009-0001.dcm"),
              std::string::npos);
    // The interpolated slice is the mean of its neighbours, to the rounding of one HU.
    EXPECT_NEAR(ct.volume.value({250, 250, 3}),
                0.5 * (ct.volume.value({250, 250, 2}) + ct.volume.value({250, 250, 4})), 0.51);
}

TEST(Nasty, RepeatedPositionsAreTwoVolumes) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto mr = open("nasty_mr_duplicate_pos_ge_8");
    const auto all = dicom::selections(mr.catalogue);
    ASSERT_EQ(all.size(), 2U);
    for (const auto &s : all) {
        EXPECT_EQ(s.volume->geometry.lattice.size().k, 4);
        EXPECT_TRUE(s.volume->notes.warnings.empty());
    }
}

TEST(Nasty, MixedSeriesKeepsItsSurveysApartAndListsItsColorPages) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto catalogue = dicom::scan({test::testData() / "nasty_ct_mixed_series_philips"});
    EXPECT_EQ(dicom::selections(catalogue).size(), 2U);
    int color = 0;
    for (const auto &s : catalogue.skipped)
        color += s.reason.english().find("color") != std::string::npos ? 1 : 0;
    EXPECT_EQ(color, 3);
}

TEST(Nasty, EnhancedMrIsFourTimePointsOfSixSlices) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto mr = open("nasty_mr_enhanced_siemens_xa10");
    const auto all = dicom::selections(mr.catalogue);
    ASSERT_EQ(all.size(), 4U);
    for (const auto &s : all) {
        EXPECT_EQ(s.volume->geometry.lattice.size(), (volume::GridSize{64, 64, 6}));
        EXPECT_NEAR(s.volume->geometry.lattice.sliceDistanceMm(), 2.4, 1e-3);
    }
}

TEST(Nasty, EnhancedCtFramesAreSortedByPosition) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto catalogue =
        dicom::scan({test::testData() / "nasty_pydicom_data/eCT_Supplemental.dcm"});
    const auto &entry = *dicom::defaultSelection(catalogue).volume;
    EXPECT_EQ(entry.geometry.lattice.size(), (volume::GridSize{512, 512, 2}));
    EXPECT_NEAR(entry.geometry.lattice.sliceDistanceMm(), 10.0, 1e-6);
    EXPECT_EQ(entry.frames[0].frame, 1); // the normal points down, so the upper frame comes first
    const auto loaded = dicom::loadVolume(entry);
    EXPECT_EQ(loaded.volume.unit(), volume::ValueUnit::hounsfield);
    // The fragmented JPEG version of the same frames without an offset table.
    const auto fragmented = dicom::scan(
        {test::testData() / "nasty_misc_cs3d/CT0012.fragmented_no_bot_jpeg_baseline.51.dcm"});
    const auto lossy = dicom::loadVolume(*dicom::defaultSelection(fragmented).volume);
    EXPECT_TRUE(lossy.volume.notes().lossy);
    EXPECT_EQ(lossy.volume.lattice().size(), loaded.volume.lattice().size());
}

TEST(Nasty, AFlippedColumnAxisWithUnknownVrs) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto catalogue =
        dicom::scan({test::testData() / "nasty_pydicom_data/explicit_VR-UN.dcm"});
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    EXPECT_NEAR(loaded.volume.lattice().step(1).y, -0.859375, 1e-9);
    EXPECT_NEAR(loaded.volume.lattice().step(2).z, -1.0, 1e-9);
    EXPECT_LE(volume::statistics(loaded.volume).minimum, -900.0);
}

TEST(Nasty, HighBitsAreMaskedAndSignsExtended) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path folder = test::testData() / "nasty_mr_12bit_signed";
    const auto original = decoded(folder / "12bitUnsigned.dcm");
    const auto striped = decoded(folder / "12bitUnsigned_0x0F0F.dcm");
    const auto signedOne = decoded(folder / "12bitSigned_0x0F0F.dcm");
    // The stripes set bits 0x0F0F and 0xFFFF: their 12 bits are 0xF0F and 0xFFF, or -241 and -1.
    const auto count = [](const decoding::DecodedImage &image, int value) {
        return std::count(image.samples.begin(), image.samples.end(), std::uint16_t(value));
    };
    EXPECT_GT(count(striped, 0xF0F), 0);
    EXPECT_EQ(*std::max_element(striped.samples.begin(), striped.samples.end()), 0xFFF);
    EXPECT_GT(count(signedOne, -241), 0);
    EXPECT_GT(count(signedOne, -1), 0);
    for (const std::uint16_t v : signedOne.samples)
        ASSERT_TRUE(std::int16_t(v) >= -2048 && std::int16_t(v) <= 2047);
    EXPECT_LE(*std::max_element(original.samples.begin(), original.samples.end()), 0xFFF);
}

TEST(Nasty, SignednessOfJpeg2000FollowsTheHeader) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto image = decoded(test::testData() / "nasty_pydicom/J2K_pixelrep_mismatch.dcm");
    int low = 32767, high = -32768;
    for (const std::uint16_t v : image.samples) {
        low = std::min(low, int(std::int16_t(v)));
        high = std::max(high, int(std::int16_t(v)));
    }
    EXPECT_EQ(low, -2000); // the padding around the reconstruction circle
    EXPECT_GT(high, 500);
    EXPECT_LT(high, 4096);
}

TEST(Nasty, MonochromeOneAndModalityTable) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto cr = dicom::scan({test::testData() / "nasty_pydicom_data/RG3_J2KR.dcm"});
    EXPECT_TRUE(dicom::defaultSelection(cr).volume->notes.darkIsHigh);
    EXPECT_FALSE(dicom::defaultSelection(cr).volume->placed);
    const auto lut = dicom::scan({test::testData() / "nasty_pydicom_data/mlut_18.dcm"});
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(lut).volume);
    const auto header =
        decoding::Decoder::shared().header(test::testData() / "nasty_pydicom_data/mlut_18.dcm");
    ASSERT_FALSE(header.modalityTable.empty());
    EXPECT_GE(volume::statistics(loaded.volume).minimum, 0.0); // table entries are unsigned
}

TEST(Nasty, UnusableFilesAreRefusedWithAReason) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto catalogue =
        dicom::scan({test::testData() / "nasty_pydicom", test::testData() / "nasty_misc_cs3d"});
    const std::pair<const char *, const char *> expected[] = {
        {"rtstruct.dcm", "segmentation"},        {"test-SR.dcm", "no pixel data"},
        {"no-pixel-data.dcm", "no pixel data"},  {"liver_1frame.dcm", "segmentation"},
        {"SC_rgb_small_odd.dcm", "color"},       {"no-pixel-spacing.dcm", "color"},
        {"TestPattern_Palette_16.dcm", "color"}, {"rtplan_truncated.dcm", "damaged"}};
    for (const auto &[name, reason] : expected) {
        const auto it = std::find_if(catalogue.skipped.begin(), catalogue.skipped.end(),
                                     [&](const auto &s) { return s.path.filename() == name; });
        ASSERT_NE(it, catalogue.skipped.end()) << name;
        const std::string why = it->reason.english();
        EXPECT_NE(why.find(reason), std::string::npos) << name << ": " << why;
    }
    // Without its intact copy, the truncated file is refused too.
    const auto alone = dicom::scan({test::testData() / "nasty_pydicom/MR_truncated.dcm"});
    try {
        dicom::loadVolume(*dicom::defaultSelection(alone).volume);
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        EXPECT_NE(std::string(error.what()).find("truncated"), std::string::npos) << error.what();
    }
}

TEST(Nasty, DicomdirsOfEveryKindListTheirFiles) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path folder = test::testData() / "nasty_dicomdir_pydicom/dicomdirtests";
    std::size_t known = 0;
    for (const char *name : {"DICOMDIR", "DICOMDIR-bigEnd", "DICOMDIR-implicit",
                             "DICOMDIR-nooffset", "DICOMDIR-nopatient", "DICOMDIR-reordered"}) {
        const auto directory = decoding::Decoder::shared().directory(folder / name);
        EXPECT_TRUE(directory.isDirectory) << name;
        EXPECT_GT(directory.files.size(), 0U) << name;
        for (const auto &parts : directory.files)
            known += fs::exists(folder / parts[0]) ? 1 : 0;
    }
    EXPECT_GT(known, 0U);
    EXPECT_TRUE(decoding::Decoder::shared().directory(folder / "DICOMDIR-empty.dcm").files.empty());
    EXPECT_EQ(decoding::Decoder::shared().directory(folder / "TINY_ALPHA/DICOMDIR").files.size(),
              50U);
    // The index leads to the same files as a search of its folders, used or not.
    const auto seen = [](const dicom::Catalogue &catalogue) {
        std::set<fs::path> paths;
        for (const auto &s : dicom::selections(catalogue))
            for (const auto &frame : s.volume->frames)
                paths.insert(frame.path);
        for (const auto &s : catalogue.skipped)
            paths.insert(s.path);
        return paths;
    };
    EXPECT_EQ(seen(dicom::scan({folder / "DICOMDIR"})),
              seen(dicom::scan({folder / "77654033", folder / "98892001", folder / "98892003"})));
}

TEST(RealSeries, TheBonsaiIsAnNrrdVolume) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto bonsai = decoding::readVolumeFile(test::testData() / "vol_bonsai_256/bonsai.nhdr");
    EXPECT_EQ(bonsai.lattice().size(), (volume::GridSize{256, 256, 256}));
    EXPECT_EQ(volume::statistics(bonsai).maximum, 255.0);
}

} // namespace
} // namespace pellucid
