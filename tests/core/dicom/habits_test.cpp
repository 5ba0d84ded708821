// SPDX-License-Identifier: GPL-3.0-or-later
// Series as scanners, anonymisers and converters write them, each with one of their habits.
// outcomes.md states the outcome of each; habit_voxels_test.cpp compares the voxels.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <map>
#include <span>

#include "core/decoding/process/parse.h"
#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "tests/core/dicom/habit_frames.h"
#include "tests/core/dicom/outcome.h"
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

// Replaces bytes of each file, such as its transfer syntax, by as many others.
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
using Turn = std::function<void(SeriesKnobs &)>;

// Functions that write a series with a habit, by the habit's name.
class HabitList {
public:
    void add(const std::string &name, const Turn &turn, const Form &form = Form()) {
        writers[name] = [turn, form](const fs::path &folder) {
            SeriesKnobs knobs;
            turn(knobs);
            test::writeSeries(folder, knobs, form);
        };
    }
    // Adds a series in a transfer syntax whose files are then changed.
    void addCoded(const std::string &name, dicom::TransferSyntax syntax,
                  const std::function<void(const fs::path &)> &then) {
        writers[name] = [syntax, then](const fs::path &folder) {
            dicom::writeCtSeries(folder, smallHead(), {}, syntax);
            then(folder);
        };
    }

    std::map<std::string, Write> writers;
};

// Identifiers that are incomplete or wrong.
void addIdentifiers(HabitList &all) {
    all.add("each slice its own frame of reference", [](auto &k) { k.ownFrames = true; });
    all.add("each slice its own frame of reference, but two that share one", [](auto &k) {
        k.slices = 20;
        k.change = [](DicomWriter &w, int slice) {
            w.put({0x0020, 0x0052}, "UI", "1.2.3." + std::to_string(std::max(1, slice)));
        };
    });
    all.add("each slice its own study", [](auto &k) { k.ownStudies = true; });
    all.add("one instance UID in all slices", [](auto &k) { k.slices = 93, k.oneInstance = true; });
    all.writers["an Enhanced file and its slices under one instance UID"] =
        [](const fs::path &folder) {
            SeriesKnobs knobs;
            knobs.slices = 7;
            knobs.oneInstance = true;
            test::writeSeries(folder, knobs);
            enhanced(knobs).write(folder / "enhanced.dcm");
        };
}

// Positions, axes and spacings that are rounded, jitter or are missing.
void addGeometry(HabitList &all) {
    all.add("positions with one decimal",
            [](auto &k) { k.slices = 114, k.stepMm = 1.25, k.positionDigit = 0.1; });
    all.add("positions with one decimal, a slice missing", [](auto &k) {
        k.slices = 114, k.stepMm = 1.25, k.positionDigit = 0.1, k.missing = {50};
    });
    all.add("two slices missing side by side", [](auto &k) {
        k.slices = 30, k.missing = {11, 12};
    });
    all.add("axes jitter by 1e-4", [](auto &k) { k.axisJitterRad = 1e-4; });
    all.add("axes jitter by 1e-3", [](auto &k) { k.slices = 30, k.axisJitterRad = 1e-3; });
    all.add("pixel spacings 3.2000 and 3.2002", [](auto &k) {
        k.pixelMm = {3.2, 3.2}, k.pixelJitter = 6e-5;
    });
}

void addMosaics(HabitList &all) {
    all.add("a Siemens mosaic", [](auto &k) { k = mosaicKnobs(); });
    all.add("a Siemens mosaic that counts its images in 0019,100A", [](auto &k) {
        k = mosaicKnobs();
        k.change = [old = k.change](DicomWriter &w, int n) {
            old(w, n);
            w.remove({0x0029, 0x1010});
            w.put({0x0019, 0x0010}, "LO", std::string("SIEMENS MR HEADER"));
            w.putShort({0x0019, 0x100A}, 11);
        };
    });
    all.add("a Siemens mosaic that counts nothing", [](auto &k) {
        k = mosaicKnobs();
        k.change = [old = k.change](DicomWriter &w, int n) {
            old(w, n);
            w.remove({0x0029, 0x1010});
        };
    });
}

// Pixels in one fragment, encoded by a function.
Turn fragments(const std::function<std::string(const std::string &)> &code) {
    return [code](SeriesKnobs &k) {
        k.change = [code](DicomWriter &w, int) {
            w.putFragments({code(w.text(DicomWriter::pixelData))});
            w.remove(DicomWriter::pixelData);
        };
    };
}

void addFragments(HabitList &all) {
    const auto xl = [](int bits) {
        return [bits](const std::string &pixels) { return jpegXl(pixels, 8, 10, bits); };
    };
    all.add("JPEG XL", fragments(xl(16)), {.syntax = "1.2.840.10008.1.2.4.110"});
    all.add("JPEG XL of 12 bits",
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
    all.add("JPEG XL that is cut off", fragments([=](const std::string &pixels) {
                const std::string whole = xl(16)(pixels);
                return whole.substr(0, whole.size() / 2);
            }),
            {.syntax = "1.2.840.10008.1.2.4.110"});
    all.add("an unknown syntax", fragments(xl(16)), {.syntax = "1.2.840.10008.1.2.4.999"});
    all.add("run lengths", fragments([](const auto &p) { return runLengths(p); }),
            {.syntax = "1.2.840.10008.1.2.5"});
    all.add("run lengths without an end", fragments([](const auto &p) { return runLengths(p); }),
            {.syntax = "1.2.840.10008.1.2.5", .hasDelimiter = false});
    all.add("run lengths of too few bytes",
            fragments([](const auto &p) { return runLengths(p, 3); }),
            {.syntax = "1.2.840.10008.1.2.5"});
}

// Headers that contradict the pixels, and images that this program cannot show.
void addHeaders(HabitList &all) {
    all.add("plain pixels under a compressed syntax", [](auto &) {},
            {.syntax = "1.2.840.10008.1.2.4.90"});
    all.add("implicit data labelled explicit", [](auto &) {}, {.isImplicit = true});
    all.add("three samples of MONOCHROME2", [](auto &k) {
        k.change = [](DicomWriter &w, int) { w.putShort({0x0028, 0x0002}, 3); };
    });
    all.add("a label map", [](auto &k) {
        k.change = [](DicomWriter &w, int) {
            w.put({0x0008, 0x0016}, "UI", std::string("1.2.840.10008.5.1.4.1.1.66.7"));
        };
    });
    all.add("an image of 20000 columns",
            [](auto &k) { k.slices = 1, k.rows = 2, k.columns = 20000; });
}

// Takes the only fragment of each file out of its item.
void unwrapFragments(const fs::path &folder) {
    for (const auto &entry : fs::directory_iterator(folder)) {
        std::string bytes = test::readText(entry.path());
        const auto at = bytes.find(std::string("\xE0\x7F\x10\x00OB\0\0\xFF\xFF\xFF\xFF", 12));
        ASSERT_NE(at, bytes.npos);
        const auto begin = bytes.find("\xFF\x4F\xFF\x51", at);
        const std::string stream = bytes.substr(begin, bytes.size() - 8 - begin);
        bytes =
            bytes.substr(0, at + 8) + DicomWriter::number(std::uint32_t(stream.size())) + stream;
        test::writeText(entry.path(), bytes);
    }
}

// Streams that contradict the header.
void addContradictions(HabitList &all) {
    using dicom::TransferSyntax;
    all.addCoded("a bare JPEG 2000 stream of defined length", TransferSyntax::jpeg2000,
                 unwrapFragments);
    all.addCoded("lossless JPEG labelled baseline", TransferSyntax::jpegLossless,
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
    all.addCoded("JPEG smaller than the header says", TransferSyntax::jpegLossless, rows(31));
    all.addCoded("JPEG larger than the header says", TransferSyntax::jpegLossless, rows(29));
    all.addCoded("JPEG-LS larger than the header says", TransferSyntax::jpegLs, rows(29));
    all.addCoded("JPEG 2000 larger than the header says", TransferSyntax::jpeg2000, rows(29));
    all.addCoded("lossless JPEG of more bits than BitsStored", TransferSyntax::jpegLossless,
                 [](const fs::path &folder) {
                     relabel(folder, std::string("\x28\0\1\1US\2\0\x10\0", 10),
                             std::string("\x28\0\1\1US\2\0\x0A\0", 10));
                     relabel(folder, std::string("\x28\0\2\1US\2\0\x0F\0", 10),
                             std::string("\x28\0\2\1US\2\0\x09\0", 10));
                 });
}

// Series whose images disagree: the one of this slice differs from the others.
void addDisagreements(HabitList &all) {
    constexpr int odd = 3;
    const auto add = [&](const std::string &what, const std::function<void(DicomWriter &)> &change,
                         const Turn &turn = {}) {
        all.add("one image of another " + what, [=](SeriesKnobs &k) {
            if (turn)
                turn(k);
            k.change = [change, old = k.change](DicomWriter &w, int slice) {
                if (old)
                    old(w, slice);
                if (slice == odd)
                    change(w);
            };
        });
    };
    const auto text = [](DicomWriter::Tag tag, const char *vr, const std::string &value) {
        return [=](DicomWriter &w) { w.put(tag, vr, value); };
    };
    const auto numbers = [](DicomWriter::Tag tag, const std::vector<double> &values) {
        return [=](DicomWriter &w) { w.putNumbers(tag, values); };
    };
    const auto each = [](const std::function<void(DicomWriter &)> &change) {
        return [=](SeriesKnobs &k) { k.change = [=](DicomWriter &w, int) { change(w); }; };
    };
    add("size", [](DicomWriter &w) {
        w.putShort({0x0028, 0x0010}, 4);
        w.putShort({0x0028, 0x0011}, 20);
    });
    add("number of bits", [](DicomWriter &w) {
        w.putShort({0x0028, 0x0101}, 12);
        w.putShort({0x0028, 0x0102}, 11);
    });
    add("signedness", [](DicomWriter &w) { w.putShort({0x0028, 0x0103}, 0); });
    add("rescale", numbers({0x0028, 0x1052}, {-1024.0}));
    add("rescale, which is missing", [](DicomWriter &w) {
        w.remove({0x0028, 0x1052});
        w.remove({0x0028, 0x1053});
    });
    add("rescale type", text({0x0028, 0x1054}, "LO", "US"),
        each(text({0x0028, 0x1054}, "LO", "HU")));
    add("photometric interpretation", text({0x0028, 0x0004}, "CS", "MONOCHROME1"));
    add("presentation", text({0x2050, 0x0020}, "CS", "INVERSE"));
    add("window", [](DicomWriter &w) {
        w.putNumbers({0x0028, 0x1050}, {-600.0});
        w.putNumbers({0x0028, 0x1051}, {1500.0});
    });
    add("orientation", numbers({0x0020, 0x0037}, {1.0, 0.0, 0.0, 0.0, 0.0, -1.0}));
    add("pixel spacing", numbers({0x0028, 0x0030}, {2.0, 2.0}));
    add("slice thickness", numbers({0x0018, 0x0050}, {5.0}));
    add("place beside the others", numbers({0x0020, 0x0032}, {15.0, 7.0, -25.7}));
    add("place between the others", numbers({0x0020, 0x0032}, {-5.0, 7.0, -26.4}));
    add("frame of reference", text({0x0020, 0x0052}, "UI", "1.2.3"));
    add("modality", text({0x0008, 0x0060}, "CS", "MR"));
    add("patient", text({0x0010, 0x0020}, "LO", "another"));
    add("birth date", text({0x0010, 0x0030}, "DA", "19500101"),
        each(text({0x0010, 0x0030}, "DA", "19700101")));
    add("sex", text({0x0010, 0x0040}, "CS", "M"), each(text({0x0010, 0x0040}, "CS", "F")));
    add("study", text({0x0020, 0x000D}, "UI", "1.2.3"));
    add("kind of object", text({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.7"));
    add("image type", text({0x0008, 0x0008}, "CS", "DERIVED\\SECONDARY"));
    add("kernel", text({0x0018, 0x1210}, "SH", "B80f"), each(text({0x0018, 0x1210}, "SH", "B30f")));
    add("tube voltage", numbers({0x0018, 0x0060}, {80.0}),
        each(numbers({0x0018, 0x0060}, {120.0})));
}

std::map<std::string, Write> habits() {
    HabitList all;
    addIdentifiers(all);
    addGeometry(all);
    addMosaics(all);
    addFragments(all);
    addHeaders(all);
    addContradictions(all);
    addDisagreements(all);
    return all.writers;
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

TEST(Habits, HugeImagesOpenOnRequest) {
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), {.slices = 1, .rows = 2, .columns = 20000});
    const auto refused = dicom::scan({folder.path()});
    ASSERT_EQ(refused.skipped.size(), 1U);
    EXPECT_TRUE(refused.skipped[0].isHuge);
    EXPECT_TRUE(refused.empty());
    const auto taken = dicom::scan({folder.path()}, {}, {.includesHuge = true});
    EXPECT_TRUE(taken.skipped.empty());
    EXPECT_EQ(dicom::defaultSelection(taken).volume->geometry.lattice.size().i, 20000);
}

// Ten times as many frames take ten times as long, or twice that beyond the caches, but not a
// hundred times.
TEST(Habits, HeaderTimeIsProportionalToFrames) {
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
            const std::clock_t start = std::clock(); // CPU time of this process alone
            const auto header = decoding::process::parseHeader(std::as_bytes(std::span(file)));
            fastest = std::min(fastest, double(std::clock() - start));
            EXPECT_EQ(header.frames.size(), std::size_t(frames));
        }
        return fastest;
    };
    EXPECT_LT(seconds(20000), 40.0 * seconds(2000));
}

} // namespace pellucid
