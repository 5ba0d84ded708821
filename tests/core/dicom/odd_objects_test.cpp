// SPDX-License-Identifier: GPL-3.0-or-later
// Objects of nuclear medicine, cone-beam scanners and radiography, and those of careless writers:
// they open as what they are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/dicom/load_volume.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "tests/core/dicom/habit_frames.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace because = task::because;
using test::DicomWriter;
using test::SeriesKnobs;
using Change = std::function<void(DicomWriter &w, int slice)>;

// All volumes of a series.
std::vector<volume::Volume> volumesOf(const SeriesKnobs &knobs) {
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), knobs);
    std::vector<volume::Volume> volumes;
    const dicom::Catalogue catalogue = dicom::scan({folder.path()});
    for (const dicom::Selection &selection : dicom::selections(catalogue))
        volumes.push_back(dicom::loadVolume(*selection.volume).volume);
    return volumes;
}

std::vector<volume::Volume> volumesOf(const Change &change) {
    SeriesKnobs knobs;
    knobs.change = change;
    return volumesOf(knobs);
}

bool isWarnedOf(const volume::Volume &volume, const auto &reason) {
    const auto &warnings = volume.notes().warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const task::Reason &warning) { return warning.is(reason); });
}

// One file of `frames` frames, of which each sample is 100 times its frame.
SeriesKnobs oneFile(int frames, const Change &change) {
    SeriesKnobs knobs;
    knobs.slices = 1;
    knobs.change = [=](DicomWriter &w, int n) {
        w.put({0x0028, 0x0008}, "IS", std::to_string(frames));
        std::string pixels;
        for (int frame = 0; frame < frames; ++frame)
            for (int sample = 0; sample < 80; ++sample)
                pixels += DicomWriter::number(std::uint16_t(100 * frame));
        w.put(DicomWriter::pixelData, "OW", pixels);
        change(w, n);
    };
    return knobs;
}

void putVector(DicomWriter &w, DicomWriter::Tag tag, const std::vector<int> &values) {
    std::string bytes;
    for (const int value : values)
        bytes += DicomWriter::number(std::uint16_t(value));
    w.put(tag, "US", bytes);
}

// Reconstructed nuclear medicine, whose detector states the place of the first slice.
void makeTomography(DicomWriter &w, double spacingMm) {
    w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\RECON TOMO\\EMISSION"));
    w.put({0x0008, 0x0060}, "CS", std::string("NM"));
    DicomWriter detector;
    detector.putNumbers({0x0020, 0x0032}, {-40.0, -40.0, 100.0});
    detector.putNumbers({0x0020, 0x0037}, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0});
    w.putSequence({0x0054, 0x0022}, {detector});
    w.remove({0x0020, 0x0032});
    w.remove({0x0020, 0x0037});
    w.putNumbers({0x0018, 0x0088}, {spacingMm});
}

void expectSlices(const volume::Volume &volume, int slices, const glm::dvec3 &first,
                  const glm::dvec3 &step, int factor = 1, int offset = 0) {
    ASSERT_TRUE(volume.notes().placed);
    ASSERT_EQ(volume.lattice().size().k, slices);
    for (int n = 0; n < slices; ++n) {
        const glm::dvec3 voxel = volume.lattice().voxel({first + double(n) * step}).v;
        EXPECT_NEAR(voxel.x, 0.0, 1e-9);
        EXPECT_NEAR(voxel.y, 0.0, 1e-9);
        EXPECT_NEAR(voxel.z, std::round(voxel.z), 1e-9);
        EXPECT_EQ(volume.value({0, 0, int(std::lround(voxel.z))}), 100.0 * (n * factor + offset));
    }
}

} // namespace

// PS3.3, C.8.4.15: the spacing's sign is the direction along the normal of the slices.
TEST(OddObjects, TomographyOfNuclearMedicineIsAVolume) {
    for (const double spacing : {4.0, -4.0}) {
        const auto volumes = volumesOf(oneFile(10, [=](DicomWriter &w, int) {
            makeTomography(w, spacing);
            putVector(w, {0x0054, 0x0080}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
        }));
        ASSERT_EQ(volumes.size(), 1U);
        EXPECT_TRUE(volumes.front().notes().warnings.empty());
        expectSlices(volumes.front(), 10, {-40.0, -40.0, 100.0}, {0.0, 0.0, spacing});
    }
}

TEST(OddObjects, GatedTomographyHasAVolumeForEachTimeSlot) {
    const auto volumes = volumesOf(oneFile(8, [](DicomWriter &w, int) {
        makeTomography(w, 3.0);
        putVector(w, {0x0054, 0x0080}, {1, 1, 2, 2, 3, 3, 4, 4});
        putVector(w, {0x0054, 0x0070}, {1, 2, 1, 2, 1, 2, 1, 2});
        putVector(w, {0x0054, 0x0060}, {1, 1, 1, 1, 1, 1, 1, 1});
    }));
    ASSERT_EQ(volumes.size(), 2U);
    for (int slot = 0; slot < 2; ++slot)
        expectSlices(volumes[std::size_t(slot)], 4, {-40.0, -40.0, 100.0}, {0.0, 0.0, 3.0}, 2,
                     slot);
}

// Projections have the place of a detector, too, but they are no slices.
TEST(OddObjects, ProjectionsOfNuclearMedicineArePictures) {
    const auto volumes = volumesOf(oneFile(8, [](DicomWriter &w, int) {
        makeTomography(w, 3.0);
        w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\TOMO\\EMISSION"));
    }));
    ASSERT_EQ(volumes.size(), 1U);
    EXPECT_FALSE(volumes.front().notes().placed);
}

TEST(OddObjects, FramesWithOnePositionAreSlices) {
    const auto bySpacing = volumesOf(oneFile(10, [](DicomWriter &w, int) {
        w.putNumbers({0x0018, 0x0088}, {0.3});
    }));
    ASSERT_EQ(bySpacing.size(), 1U);
    EXPECT_TRUE(isWarnedOf(bySpacing.front(), because::placedBySpacing));
    expectSlices(bySpacing.front(), 10, {-5.0, 7.0, -31.7}, {0.0, 0.0, 0.3});
    const auto byThickness = volumesOf(oneFile(10, [](DicomWriter &, int) {}));
    ASSERT_EQ(byThickness.size(), 1U);
    EXPECT_TRUE(isWarnedOf(byThickness.front(), because::placedByThickness));
    expectSlices(byThickness.front(), 10, {-5.0, 7.0, -31.7}, {0.0, 0.0, 2.0});
}

// Frames in time, without a thickness, or without a position.
TEST(OddObjects, OtherFramesWithOnePositionArePictures) {
    const std::vector<Change> changes{[](DicomWriter &w, int) {
                                          w.putNumbers({0x0018, 0x1063}, {40.0});
                                      },
                                      [](DicomWriter &w, int) {
                                          w.remove({0x0018, 0x0050});
                                      },
                                      [](DicomWriter &w, int) {
                                          w.remove({0x0020, 0x0032});
                                      }};
    for (const Change &change : changes) {
        const auto volumes = volumesOf(oneFile(10, change));
        ASSERT_EQ(volumes.size(), 1U);
        EXPECT_FALSE(volumes.front().notes().placed);
    }
}

// A dose of 32 bits: the offsets of its frames, and its scale.
TEST(OddObjects, ADoseIsAVolume) {
    const auto volumes = volumesOf(oneFile(4, [](DicomWriter &w, int) {
        w.put({0x0008, 0x0060}, "CS", std::string("RTDOSE"));
        w.remove({0x0028, 0x1052});
        w.remove({0x0028, 0x1053});
        w.putNumbers({0x3004, 0x000C}, {0.0, 2.5, 5.0, 7.5});
        w.putNumbers({0x3004, 0x000E}, {0.5});
        w.putShort({0x0028, 0x0100}, 32);
        w.putShort({0x0028, 0x0101}, 32);
        w.putShort({0x0028, 0x0102}, 31);
        w.putShort({0x0028, 0x0103}, 0);
        std::string pixels;
        for (int frame = 0; frame < 4; ++frame)
            for (int sample = 0; sample < 80; ++sample)
                pixels += DicomWriter::number(std::uint32_t(200 * frame));
        w.put(DicomWriter::pixelData, "OW", pixels);
    }));
    ASSERT_EQ(volumes.size(), 1U);
    expectSlices(volumes.front(), 4, {-5.0, 7.0, -31.7}, {0.0, 0.0, 2.5});
}

// Signed values of 32 bits beyond 16: the nearest that 16 bits can hold.
TEST(OddObjects, LongSamplesKeepSixteenBits) {
    const auto valueOf = [](int sample) { return -1'000'000 + 40'000 * sample; };
    const auto volumes = volumesOf([=](DicomWriter &w, int) {
        w.putShort({0x0028, 0x0100}, 32);
        w.putShort({0x0028, 0x0101}, 32);
        w.putShort({0x0028, 0x0102}, 31);
        std::string pixels;
        for (int sample = 0; sample < 80; ++sample)
            pixels += DicomWriter::number(std::uint32_t(valueOf(sample)));
        w.put(DicomWriter::pixelData, "OW", pixels);
    });
    ASSERT_EQ(volumes.size(), 1U);
    for (int sample = 0; sample < 80; ++sample)
        EXPECT_NEAR(volumes.front().value({sample % 10, sample / 10, 3}), valueOf(sample), 64.0);
}

TEST(OddObjects, BitsAreAPicture) {
    const auto volumes = volumesOf([](DicomWriter &w, int) {
        w.putShort({0x0028, 0x0100}, 1);
        w.putShort({0x0028, 0x0101}, 1);
        w.putShort({0x0028, 0x0102}, 0);
        w.putShort({0x0028, 0x0103}, 0);
        w.put(DicomWriter::pixelData, "OB", std::string(10, '\x0B'));
    });
    ASSERT_EQ(volumes.size(), 1U);
    for (int sample = 0; sample < 80; ++sample)
        EXPECT_EQ(volumes.front().value({sample % 10, sample / 10, 0}),
                  double(0x0B >> (sample % 8) & 1));
}

// Numbers as careless programs write them.
TEST(OddObjects, MisspeltNumbersAreRead) {
    struct Case {
        const char *vr;
        std::string spacing;
        task::Because<1> warning;
    };
    for (const Case &one : {Case{"DS", "1,5\\1,25", because::decimalCommas},
                            Case{"DS", "1.5,1.25", because::decimalCommas},
                            Case{"UT", "1.5\\1.25", because::numbersOfWrongType},
                            Case{"LO", "1.5\\1.25", because::numbersOfWrongType},
                            Case{"UN", "1.5\\1.25", because::decimalCommas}}) {
        SCOPED_TRACE(one.spacing + one.vr);
        const auto volumes = volumesOf([&](DicomWriter &w, int k) {
            w.put({0x0028, 0x0030}, one.vr, one.spacing);
            w.put({0x0020, 0x0032}, "DS", "-5,0\\7,0\\" + std::to_string(2 * k));
            w.put({0x0028, 0x1050}, "DS", std::string("40,5"));
            w.put({0x0028, 0x1051}, "DS", std::string("400,0"));
        });
        ASSERT_EQ(volumes.size(), 1U);
        const volume::Volume &volume = volumes.front();
        ASSERT_TRUE(volume.notes().placed);
        EXPECT_EQ(volume.lattice().spacingMm(0), 1.25);
        EXPECT_EQ(volume.lattice().spacingMm(1), 1.5);
        EXPECT_EQ(volume.lattice().sliceDistanceMm(), 2.0);
        EXPECT_TRUE(isWarnedOf(volume, one.warning));
        ASSERT_EQ(volume.notes().windows.size(), 1U);
        EXPECT_EQ(volume.notes().windows.front().center, 40.5);
    }
    // A comma in each number, and between them.
    const auto pairs = volumesOf([](DicomWriter &w, int k) {
        w.put({0x0028, 0x0030}, "DS", std::string("1,5,1,25"));
        w.put({0x0020, 0x0032}, "DS", "-10,5,2,25," + std::to_string(2 * k) + ",0");
    });
    ASSERT_EQ(pairs.size(), 1U);
    ASSERT_TRUE(pairs.front().notes().placed);
    EXPECT_EQ(pairs.front().lattice().spacingMm(0), 1.25);
    EXPECT_EQ(pairs.front().lattice().origin().mm.x, -10.5);
    // "1,5" is one number: half of a spacing.
    const auto half = volumesOf([](DicomWriter &w, int) {
        w.put({0x0028, 0x0030}, "DS", std::string("1,5"));
    });
    ASSERT_EQ(half.size(), 1U);
    EXPECT_FALSE(half.front().notes().placed);
}

// One image without the intercept is no slice of a stack of HU.
TEST(OddObjects, AnImageThatStatesLessOfItsRescaleStandsAlone) {
    for (const DicomWriter::Tag &tag :
         {DicomWriter::Tag{0x0028, 0x1052}, DicomWriter::Tag{0x0028, 0x1053}}) {
        const auto volumes = volumesOf([&](DicomWriter &w, int k) {
            w.putNumbers({0x0028, 0x1052}, {-1024.0});
            w.putNumbers({0x0028, 0x1053}, {1.0});
            if (k == 0)
                w.remove(tag);
        });
        ASSERT_GE(volumes.size(), 2U);
        for (const volume::Volume &volume : volumes)
            if (volume.lattice().size().k == 1) {
                EXPECT_NE(volume.unit(), volume::ValueUnit::hounsfield);
                EXPECT_TRUE(isWarnedOf(volume, because::valuesAsStored));
            }
    }
}

TEST(OddObjects, NobodyKnowsHowThickASingleSliceIsThatDoesNotSay) {
    SeriesKnobs knobs;
    knobs.slices = 1;
    for (const bool saysSo : {false, true}) {
        knobs.change = [&](DicomWriter &w, int) {
            saysSo ? w.putNumbers({0x0018, 0x0050}, {2.5}) : w.remove({0x0018, 0x0050});
        };
        const test::TemporaryFolder folder;
        test::writeSeries(folder.path(), knobs);
        const auto catalogue = dicom::scan({folder.path()});
        EXPECT_EQ(dicom::defaultSelection(catalogue).volume->notes.hasDepth, saysSo);
    }
}

TEST(OddObjects, RadiographsSayWhereLengthsHold) {
    using volume::SpacingPlace;
    struct Case {
        Change change;
        bool hasSpacing;
        double spacingMm;
        SpacingPlace place;
    };
    const auto imager = [](DicomWriter &w) { w.putNumbers({0x0018, 0x1164}, {0.2, 0.2}); };
    const auto pixels = [](DicomWriter &w) { w.putNumbers({0x0028, 0x0030}, {0.15, 0.15}); };
    const std::vector<Case> cases{
        {[](DicomWriter &, int) {}, false, 1.0, SpacingPlace::patient},
        {[=](DicomWriter &w, int) { imager(w); }, true, 0.2, SpacingPlace::detector},
        {[=](DicomWriter &w, int) {
             imager(w);
             w.putNumbers({0x0018, 0x1114}, {1.25});
         },
         true, 0.16, SpacingPlace::magnified},
        {[=](DicomWriter &w, int) {
             imager(w);
             pixels(w);
             w.put({0x0028, 0x0A02}, "CS", std::string("FIDUCIAL"));
         },
         true, 0.15, SpacingPlace::calibrated},
        {[=](DicomWriter &w, int) {
             pixels(w);
             w.put({0x0028, 0x0A02}, "CS", std::string("GEOMETRY"));
         },
         true, 0.15, SpacingPlace::geometry},
        {[=](DicomWriter &w, int) {
             imager(w);
             w.putNumbers({0x0028, 0x0030}, {0.2, 0.2});
         },
         true, 0.2, SpacingPlace::detector}};
    for (const Case &one : cases) {
        SeriesKnobs knobs;
        knobs.slices = 1;
        knobs.modality = "CR";
        knobs.change = [&](DicomWriter &w, int n) {
            w.remove({0x0020, 0x0032});
            w.remove({0x0028, 0x0030});
            one.change(w, n);
        };
        const auto volumes = volumesOf(knobs);
        ASSERT_EQ(volumes.size(), 1U);
        const volume::VolumeNotes &notes = volumes.front().notes();
        EXPECT_EQ(notes.hasSpacing, one.hasSpacing);
        EXPECT_NEAR(volumes.front().lattice().spacingMm(0), one.spacingMm, 1e-12);
        EXPECT_EQ(notes.spacingPlace, one.place);
    }
}

// A table of 12 bits that inverts, and the functions of windows.
TEST(OddObjects, WindowsAreThoseOfTheFile) {
    const auto windowOf = [](const Change &change) {
        const auto volumes = volumesOf(change);
        EXPECT_EQ(volumes.size(), 1U);
        EXPECT_EQ(volumes.front().notes().windows.size(), 1U);
        return volumes.front().notes().windows.at(0);
    };
    const auto table = windowOf([](DicomWriter &w, int) {
        DicomWriter lut;
        std::string entries;
        for (int n = 0; n < 4096; ++n)
            entries += DicomWriter::number(std::uint16_t(4095 - n));
        lut.put({0x0028, 0x3002}, "US",
                DicomWriter::number(std::uint16_t(4096)) + DicomWriter::number(std::uint16_t(0)) +
                    DicomWriter::number(std::uint16_t(12)));
        lut.put({0x0028, 0x3006}, "OW", entries);
        w.putSequence({0x0028, 0x3010}, {lut});
    });
    for (const int value : {0, 1, 1000, 4000, 4095})
        EXPECT_NEAR(table.greyOf(value), (4095.0 - value) / 4095.0, 1e-6);
    EXPECT_EQ(table.greyOf(-10.0), 1.0);
    EXPECT_EQ(table.greyOf(5000.0), 0.0);
    const auto named = [&](const char *function, double center, double width) {
        return windowOf([=](DicomWriter &w, int) {
            w.putNumbers({0x0028, 0x1050}, {center});
            w.putNumbers({0x0028, 0x1051}, {width});
            if (*function != '\0')
                w.put({0x0028, 0x1056}, "CS", std::string(function));
        });
    };
    const auto sigmoid = named("SIGMOID", 500.0, 400.0);
    for (const double value : {0.0, 300.0, 500.0, 777.0})
        EXPECT_DOUBLE_EQ(sigmoid.greyOf(value), 1.0 / (1.0 + std::exp(-0.01 * (value - 500.0))));
    // PS3.3, C.11.2.1.2.1 and C.11.2.1.3.2
    const auto linear = named("", 2048.0, 4096.0), exact = named("LINEAR_EXACT", 2048.0, 4096.0);
    EXPECT_DOUBLE_EQ(linear.greyOf(0.0), 0.0);
    EXPECT_DOUBLE_EQ(linear.greyOf(4095.0), 1.0);
    EXPECT_DOUBLE_EQ(exact.greyOf(1024.0), 0.25);
    EXPECT_DOUBLE_EQ(exact.greyOf(4095.0), 4095.0 / 4096.0);
    // Values between 0 and 1 have narrow windows.
    EXPECT_DOUBLE_EQ(named("LINEAR", 0.5, 0.2).greyOf(0.55), 0.75);
}

// A slice that does not say what its values are is not one of those that do.
TEST(OddObjects, ASliceWithoutRescaleStandsAlone) {
    SeriesKnobs knobs;
    knobs.slices = 10;
    knobs.change = [](DicomWriter &w, int k) {
        w.putNumbers({0x0028, 0x1052}, {-1000.0});
        if (k == 5) {
            w.remove({0x0028, 0x1052});
            w.remove({0x0028, 0x1053});
        }
    };
    const auto volumes = volumesOf(knobs);
    ASSERT_EQ(volumes.size(), 2U);
    EXPECT_EQ(volumes[0].lattice().size().k, 10);
    EXPECT_EQ(volumes[0].unit(), volume::ValueUnit::hounsfield);
    EXPECT_TRUE(isWarnedOf(volumes[0], because::missingSlices));
    EXPECT_EQ(volumes[0].value({0, 0, 5}), -500.0); // between its neighbours
    EXPECT_EQ(volumes[1].unit(), volume::ValueUnit::none);
    EXPECT_TRUE(isWarnedOf(volumes[1], because::valuesAsStored));
}

TEST(OddObjects, AShiftOfTheFieldOfViewParts) {
    SeriesKnobs knobs;
    knobs.slices = 10;
    knobs.change = [](DicomWriter &w, int k) {
        w.putNumbers({0x0020, 0x0032}, {k < 5 ? 0.0 : -12.5, 0.0, 2.0 * k});
    };
    const auto volumes = volumesOf(knobs);
    ASSERT_EQ(volumes.size(), 2U);
    for (const volume::Volume &volume : volumes) {
        EXPECT_TRUE(volume.notes().placed);
        EXPECT_EQ(volume.lattice().size().k, 5);
        EXPECT_TRUE(isWarnedOf(volume, because::shiftBesideSlices));
    }
    EXPECT_EQ(volumes[1].lattice().origin().mm.x, -12.5);
}

// Anonymisers remove the private attributes with the number of slices.
TEST(OddObjects, AMosaicWithoutItsNumberOfSlicesIsSplit) {
    for (const bool isSiemensText : {false, true}) {
        SeriesKnobs knobs = test::mosaicKnobs();
        knobs.columns = 32; // square tiles
        knobs.value = [](int i, int j, int) {
            const int tile = j / 8 * 4 + i / 8;
            return tile < 11 ? 100 * tile + 10 * (j % 8) + i % 8 : 0;
        };
        knobs.change = [=, old = knobs.change](DicomWriter &w, int n) {
            old(w, n);
            w.remove({0x0029, 0x1010});
            if (isSiemensText)
                w.put({0x0051, 0x100B}, "LO", std::string("8*8"));
            else
                putVector(w, {0x0018, 0x1310}, {0, 8, 8, 0});
        };
        const auto volumes = volumesOf(knobs);
        ASSERT_EQ(volumes.size(), 1U);
        EXPECT_TRUE(isWarnedOf(volumes.front(), because::mosaicTilesGuessed));
        ASSERT_EQ(volumes.front().lattice().size(), (volume::GridSize{8, 8, 11}));
        EXPECT_EQ(volumes.front().value({3, 2, 10}), 1023.0);
    }
}

} // namespace pellucid
