// SPDX-License-Identifier: GPL-3.0-or-later
// Images that share their positions: the volumes that a scan makes of them, each of one repeat.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/dicom/load_volume.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace because = task::because;
using test::DicomWriter;

constexpr int places = 10, valueOfRepeat = 1000;

// Sets the attributes of an image.
using Attributes = std::function<void(DicomWriter &w, int repeat, int place)>;

// The order of the image numbers.
enum class Numbers { random, byRepeat, byPlace, missing };

struct Volume {
    std::string label;
    int slices = 0;
    int repeat = -1; ///< of all slices, or -1
    std::vector<task::Reason> warnings;
    bool isPlaced = true;
};

// The volumes of a series with `repeats` images at each position.
std::vector<Volume> volumesOf(int repeats, const Attributes &attributes,
                              Numbers order = Numbers::random,
                              const std::vector<int> &missing = {}) {
    const test::TemporaryFolder folder;
    std::vector<int> numbers(std::size_t(repeats * places));
    std::iota(numbers.begin(), numbers.end(), 1);
    if (order == Numbers::random) {
        std::mt19937 random(7);
        std::shuffle(numbers.begin(), numbers.end(), random);
    }
    test::SeriesKnobs knobs;
    knobs.slices = repeats * places;
    knobs.missing = missing;
    knobs.value = [](int i, int j, int n) { return n / places * valueOfRepeat + 10 * j + i; };
    knobs.change = [&](DicomWriter &w, int n) {
        const int repeat = n / places, place = n % places;
        w.putNumbers({0x0020, 0x0032}, {0.0, 0.0, 2.0 * place});
        const int number =
            numbers[std::size_t(order == Numbers::byPlace ? place * repeats + repeat : n)];
        if (order == Numbers::missing)
            w.remove({0x0020, 0x0013});
        else
            w.put({0x0020, 0x0013}, "IS", std::to_string(number));
        attributes(w, repeat, place);
    };
    test::writeSeries(folder.path(), knobs);
    std::vector<Volume> volumes;
    const dicom::Catalogue catalogue = dicom::scan({folder.path()});
    for (const dicom::Selection &selection : dicom::selections(catalogue)) {
        const volume::Volume loaded = dicom::loadVolume(*selection.volume).volume;
        Volume v{dicom::labelText(selection.volume->label), loaded.lattice().size().k, -1,
                 loaded.notes().warnings, loaded.notes().placed};
        for (int k = 0; k < v.slices; ++k) {
            const int repeat = int(loaded.value({0, 0, k})) / valueOfRepeat;
            v.repeat = k == 0 || v.repeat == repeat ? repeat : -1;
        }
        volumes.push_back(std::move(v));
    }
    return volumes;
}

// One volume for each repeat, in their order, without a warning.
void expectRepeats(const std::vector<Volume> &volumes, const std::vector<std::string> &labels) {
    ASSERT_EQ(volumes.size(), labels.size());
    for (std::size_t n = 0; n < volumes.size(); ++n) {
        EXPECT_EQ(volumes[n].label, labels[n]);
        EXPECT_EQ(volumes[n].slices, places);
        EXPECT_EQ(volumes[n].repeat, int(n));
        EXPECT_TRUE(volumes[n].warnings.empty());
    }
}

Attributes text(DicomWriter::Tag tag, const char *vr, const std::vector<std::string> &values) {
    return [=](DicomWriter &w, int repeat, int) { w.put(tag, vr, values[std::size_t(repeat)]); };
}

} // namespace

// Whatever attribute tells them apart, and with image numbers in any order.
TEST(Repeats, AnyAttributeTellsThemApart) {
    struct Case {
        DicomWriter::Tag tag;
        const char *vr;
        std::vector<std::string> values, labels;
    };
    const std::vector<Case> cases{
        {{0x0018, 0x0060}, "DS", {"80", "100", "140"}, {"80 kVp", "100 kVp", "140 kVp"}},
        {{0x0020, 0x9241}, "DS", {"0", "40", "70"}, {"0 %", "40 %", "70 %"}},
        {{0x0018, 0x1210},
         "SH",
         {"B30f", "B60f", "B80f"},
         {"kernel B30f", "kernel B60f", "kernel B80f"}},
        {{0x0018, 0x0082},
         "DS",
         {"90", "350", "2000"},
         {"inversion time 90 ms", "inversion time 350 ms", "inversion time 2000 ms"}},
        {{0x0018, 0x1314},
         "DS",
         {"2", "5", "15"},
         {"flip angle 2°", "flip angle 5°", "flip angle 15°"}},
        {{0x0054, 0x1300}, "DS", {"1000", "2000", "30000"}, {"1000 ms", "2000 ms", "30000 ms"}},
        {{0x0018, 0x0050},
         "DS",
         {"1", "2.5", "5"},
         {"Slice Thickness 1", "Slice Thickness 2.5", "Slice Thickness 5"}},
        {{0x0008, 0x103E},
         "LO",
         {"arterial", "portal", "late"},
         {"Series Description arterial", "Series Description portal", "Series Description late"}},
        {{0x0019, 0x100C},
         "IS",
         {"0", "500", "1000"},
         {"Private, MAKER (0019,100c) 0", "Private, MAKER (0019,100c) 500",
          "Private, MAKER (0019,100c) 1000"}},
    };
    for (const Case &one : cases) {
        SCOPED_TRACE(one.labels.front());
        expectRepeats(volumesOf(3,
                                [&](DicomWriter &w, int repeat, int place) {
                                    w.put({0x0019, 0x0010}, "LO", std::string("MAKER"));
                                    text(one.tag, one.vr, one.values)(w, repeat, place);
                                }),
                      one.labels);
    }
}

// Numbers that change from slice to slice, but less than between the repeats.
TEST(Repeats, ADriftingNumberTellsThemApart) {
    const auto trigger = [](double drift) {
        return [=](DicomWriter &w, int repeat, int place) {
            w.putNumbers({0x0018, 0x1060}, {100.0 * repeat + drift * place});
        };
    };
    expectRepeats(volumesOf(3, trigger(3.0)), {"15 ms", "115 ms", "215 ms"});
    // Also if they drift farther than the repeats are apart.
    expectRepeats(volumesOf(3, trigger(70.0)), {"350 ms", "450 ms", "550 ms"});
    expectRepeats(
        volumesOf(
            2,
            [](DicomWriter &w, int repeat, int place) {
                w.put({0x0008, 0x0032}, "TM", fmt::format("1159{:02}.50", 4 * place + 2 * repeat));
            }),
        {"acquisition time 115920.50", "acquisition time 115922.50"});
}

// A time that drifts may cross over; what is equal throughout a volume does not.
TEST(Repeats, AnAttributeThatIsEqualSaysMoreThanATimeThatDrifts) {
    const auto timed = [](DicomWriter &w, int repeat, int place) {
        const int earlier = place < places / 2 ? repeat : 1 - repeat;
        w.put({0x0008, 0x0033}, "TM", fmt::format("10{:02}{:02}", 10 + 6 * earlier, 2 * place));
    };
    for (const auto &[tag, vr] : {std::pair(DicomWriter::Tag{0x0018, 0x1160}, "SH"),
                                  std::pair(DicomWriter::Tag{0x0019, 0x100C}, "LO")}) {
        const auto volumes = volumesOf(2, [&](DicomWriter &w, int repeat, int place) {
            timed(w, repeat, place);
            w.put({0x0019, 0x0010}, "LO", std::string("MAKER"));
            w.put(tag, vr, std::string(repeat == 0 ? "STANDARD" : "SHARP"));
        });
        ASSERT_EQ(volumes.size(), 2U);
        for (int n = 0; n < 2; ++n) {
            EXPECT_EQ(volumes[std::size_t(n)].repeat, n);
            EXPECT_NE(volumes[std::size_t(n)].label.find(n == 0 ? "STANDARD" : "SHARP"),
                      std::string::npos);
        }
    }
    // Where both mean the same volumes, the time names them.
    expectRepeats(volumesOf(2,
                            [](DicomWriter &w, int repeat, int place) {
                                w.putNumbers({0x0018, 0x1060}, {100.0 * repeat + 3.0 * place});
                                w.put({0x0018, 0x1160}, "SH", "F" + std::to_string(repeat));
                            }),
                  {"15 ms", "115 ms"});
}

TEST(Repeats, EqualNumbersMayBeWrittenDifferently) {
    const std::vector<std::vector<std::string>> written{{"80", "80.0", "8E1"},
                                                        {"140", "140.0", "+140"}};
    expectRepeats(
        volumesOf(
            2,
            [&](DicomWriter &w, int repeat, int place) {
                w.put({0x0018, 0x0060}, "DS", written[std::size_t(repeat)][std::size_t(place % 3)]);
            }),
        {"80 kVp", "140 kVp"});
    expectRepeats(
        volumesOf(2,
                  [&](DicomWriter &w, int repeat, int) {
                      w.put({0x0043, 0x0010}, "LO", std::string("GEMS_PARM_01"));
                      w.put({0x0043, 0x1039}, "IS",
                            std::string(repeat == 0 ? "50\\8\\0\\0" : "1000000800\\8\\0\\0"));
                  }),
        {"b-value 50", "b-value 800"});
}

TEST(Repeats, SeveralAttributesTellThemApartTogether) {
    const auto volumes = volumesOf(4, [](DicomWriter &w, int repeat, int place) {
        w.put({0x0018, 0x0060}, "DS", std::string(repeat < 2 ? "80" : "140"));
        w.putNumbers({0x0018, 0x1060}, {100.0 * (repeat % 2) + 3.0 * place});
    });
    expectRepeats(volumes,
                  {"80 kVp, 15 ms", "80 kVp, 115 ms", "140 kVp, 15 ms", "140 kVp, 115 ms"});
}

// A missing image does not hide what tells the others apart.
TEST(Repeats, WithoutOneImageTheyAreStillToldApart) {
    const auto volumes =
        volumesOf(4,
                  [](DicomWriter &w, int repeat, int) {
                      w.put({0x0018, 0x0060}, "DS", std::string(repeat < 2 ? "80" : "140"));
                      w.put({0x0018, 0x1210}, "SH", std::string(repeat % 2 == 0 ? "B30f" : "B60f"));
                  },
                  Numbers::byPlace, {2 * places + 4});
    ASSERT_EQ(volumes.size(), 4U);
    for (int n = 0; n < 4; ++n) {
        const Volume &volume = volumes[std::size_t(n)];
        EXPECT_EQ(volume.repeat, n);
        EXPECT_EQ(volume.slices, places);
        EXPECT_EQ(volume.warnings.size(), n == 2 ? 1U : 0U);
    }
    // Numbers alone would shift the sets from the gap on.
    const auto unknown =
        volumesOf(3, [](DicomWriter &, int, int) {}, Numbers::byPlace, {places + 4});
    ASSERT_EQ(unknown.size(), 1U);
    EXPECT_FALSE(unknown.front().isPlaced);
}

// Odd and even slices of one stack, as MR scanners acquire them, of which one is missing.
TEST(Repeats, PackagesOfOneStackStayTogether) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs;
    knobs.slices = 40;
    knobs.missing = {1};
    knobs.change = [](DicomWriter &w, int slice) {
        w.put({0x0020, 0x0012}, "IS", std::to_string(slice % 2 + 1));
    };
    test::writeSeries(folder.path(), knobs);
    const dicom::Catalogue catalogue = dicom::scan({folder.path()});
    ASSERT_EQ(dicom::selections(catalogue).size(), 1U);
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    EXPECT_EQ(loaded.volume.lattice().size().k, 40);
}

// Fields of view beside each other, such as two knees, whose images share their depths.
TEST(Repeats, PlacesWithinThePlaneTellThemApart) {
    // The middle of ten columns of 1 mm is 4.5 mm from the first.
    const auto at = [](DicomWriter &w, double middle, int place) {
        w.putNumbers({0x0020, 0x0032}, {middle - 4.5, 0.0, 2.0 * place});
    };
    const auto knees = [&](DicomWriter &w, int repeat, int place) {
        at(w, repeat == 0 ? -100.0 : 100.0, place);
    };
    const std::vector<std::string> sides{"at 100 mm right", "at 100 mm left"};
    expectRepeats(volumesOf(2, knees), sides);
    // Whatever else differs: here a number that means nothing.
    expectRepeats(volumesOf(2,
                            [&](DicomWriter &w, int repeat, int place) {
                                knees(w, repeat, place);
                                w.put({0x0020, 0x0012}, "IS", std::to_string(place % 2));
                            }),
                  sides);
    // A missing slice; the other knee has it.
    const auto missing = volumesOf(2, knees, Numbers::random, {4});
    ASSERT_EQ(missing.size(), 2U);
    for (int n = 0; n < 2; ++n) {
        EXPECT_EQ(missing[std::size_t(n)].label, sides[std::size_t(n)]);
        EXPECT_EQ(missing[std::size_t(n)].repeat, n);
        EXPECT_EQ(missing[std::size_t(n)].warnings.size(), n == 0 ? 1U : 0U);
    }
    // An attribute tells apart what is at one place.
    expectRepeats(
        volumesOf(4,
                  [&](DicomWriter &w, int repeat, int place) {
                      knees(w, repeat / 2, place);
                      w.put({0x0018, 0x0060}, "DS", std::string(repeat % 2 == 0 ? "80" : "140"));
                  }),
        {"at 100 mm right, 80 kVp", "at 100 mm right, 140 kVp", "at 100 mm left, 80 kVp",
         "at 100 mm left, 140 kVp"});
    // Places that drift with the depth: the label is that of the middle slice.
    const auto slanted = volumesOf(2, [&](DicomWriter &w, int repeat, int place) {
        at(w, (repeat == 0 ? -100.0 : 100.0) + 0.9 * place, place);
    });
    ASSERT_EQ(slanted.size(), 2U);
    for (int n = 0; n < 2; ++n) {
        EXPECT_EQ(slanted[std::size_t(n)].label, n == 0 ? "at 95.5 mm right" : "at 104.5 mm left");
        EXPECT_EQ(slanted[std::size_t(n)].repeat, n);
    }
}

// A part of a pixel is no other place, and where most of the field of view is shared, an attribute
// says more.
TEST(Repeats, SmallShiftsWithinThePlaneAreTheLastThatTells) {
    const auto shifted = [](double mm) {
        return [mm](DicomWriter &w, int repeat, int place) {
            w.putNumbers({0x0020, 0x0032}, {mm * repeat - 3.5, 0.0, 2.0 * place});
        };
    };
    const auto rounded = volumesOf(2, shifted(0.1));
    ASSERT_EQ(rounded.size(), 1U);
    EXPECT_FALSE(rounded.front().isPlaced);
    expectRepeats(volumesOf(2, shifted(3.0)), {"at 1 mm left", "at 4 mm left"});
    expectRepeats(volumesOf(2,
                            [&](DicomWriter &w, int repeat, int place) {
                                shifted(3.0)(w, repeat, place);
                                w.put({0x0018, 0x0050}, "DS", std::string(repeat == 0 ? "1" : "5"));
                            }),
                  {"Slice Thickness 1", "Slice Thickness 5"});
}

// Random numbers are no reason to mix the repeats.
TEST(Repeats, NoiseTellsNothing) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> values(0.0, 1000.0);
    const auto volumes = volumesOf(3, [&](DicomWriter &w, int, int) {
        w.putNumbers({0x0018, 0x1060}, {values(random)});
        w.putNumbers({0x0018, 0x9345}, {values(random)});
    });
    // Of two repeats, one order in every few is as if it meant something.
    for (int series = 0; series < 20; ++series) {
        const auto pairs = volumesOf(2,
                                     [&](DicomWriter &w, int, int) {
                                         w.putNumbers({0x0018, 0x9345}, {values(random)});
                                     },
                                     Numbers::random, {5, 6, 7, 8, 9, 15, 16, 17, 18, 19});
        EXPECT_EQ(pairs.size(), 1U);
    }
    ASSERT_EQ(volumes.size(), 1U);
    EXPECT_FALSE(volumes.front().isPlaced);
    ASSERT_EQ(volumes.front().warnings.size(), 1U);
    EXPECT_TRUE(volumes.front().warnings.front().is(because::imagesOnly));
}

// The last resort is marked as a guess.
TEST(Repeats, NumbersInOrderAreAGuess) {
    const auto nothing = [](DicomWriter &, int, int) {};
    for (const Numbers order : {Numbers::byRepeat, Numbers::byPlace}) {
        const auto volumes = volumesOf(3, nothing, order);
        ASSERT_EQ(volumes.size(), 3U);
        for (int n = 0; n < 3; ++n) {
            const Volume &volume = volumes[std::size_t(n)];
            EXPECT_EQ(volume.label, "set " + std::to_string(n + 1));
            EXPECT_EQ(volume.repeat, n);
            ASSERT_EQ(volume.warnings.size(), 1U);
            EXPECT_TRUE(volume.warnings.front().is(because::toldApartByNumber));
        }
    }
    for (const Numbers order : {Numbers::random, Numbers::missing}) {
        const auto volumes = volumesOf(3, nothing, order);
        ASSERT_EQ(volumes.size(), 1U);
        EXPECT_FALSE(volumes.front().isPlaced);
    }
}

// Scans that overlap, one between the slices of the other.
TEST(Repeats, OverlappingScansAreVolumesOfTheirOwn) {
    const auto scans = [](DicomWriter &w, int repeat, int place) {
        w.putNumbers({0x0020, 0x0032}, {0.0, 0.0, 2.0 * place + 0.7 * repeat});
    };
    expectRepeats(volumesOf(2,
                            [&](DicomWriter &w, int repeat, int place) {
                                scans(w, repeat, place);
                                w.put({0x0020, 0x0012}, "IS", std::to_string(repeat + 1));
                            }),
                  {"acquisition 1", "acquisition 2"});
    expectRepeats(volumesOf(2,
                            [&](DicomWriter &w, int repeat, int place) {
                                scans(w, repeat, place);
                                w.put({0x0018, 0x1030}, "LO", "part " + std::to_string(repeat));
                            }),
                  {"Protocol Name part 0", "Protocol Name part 1"});
    // Halfway between each other they would be even together; thick slices tell that they are not.
    const auto halfway = [&](double thicknessMm) {
        return volumesOf(2, [=](DicomWriter &w, int repeat, int place) {
            w.putNumbers({0x0020, 0x0032}, {0.0, 0.0, 2.0 * place + repeat});
            w.putNumbers({0x0018, 0x0050}, {thicknessMm});
            w.put({0x0020, 0x0012}, "IS", std::to_string(repeat + 1));
        });
    };
    expectRepeats(halfway(2.0), {"acquisition 1", "acquisition 2"});
    const auto packages = halfway(1.0);
    ASSERT_EQ(packages.size(), 1U);
    EXPECT_EQ(packages.front().slices, 2 * places);
    // Nothing tells them apart: one volume, which says that it is uneven.
    const auto mixed = volumesOf(2, scans);
    ASSERT_EQ(mixed.size(), 1U);
    EXPECT_EQ(mixed.front().repeat, -1);
    EXPECT_FALSE(mixed.front().warnings.empty());
}

} // namespace pellucid
