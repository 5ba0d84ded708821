// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/segmentation.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/segment/reasons.h"
#include "core/segment/segment_set.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/nrrd.h"
#include "tests/support/dice.h"
#include "tests/support/segmentation_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {
namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using segment::Segmentation;
using test::dice;
using test::DicomWriter;
using test::tilted;
using test::volumeOn;
using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::Volume;
using volume::VoxelIndex;

task::Reason reasonOf(const fs::path &file, const Volume &volume) {
    try {
        segment::loadSegmentation(file, volume);
    } catch (const task::Error &error) {
        EXPECT_EQ(error.path(), file);
        return error.reason();
    }
    ADD_FAILURE() << "was loaded: " << file;
    return because::isEmpty;
}

class SegmentationFiles : public testing::Test {
protected:
    // A file as the knobs say.
    fs::path write(const test::SegmentationKnobs &knobs) {
        test::segmentationFile(knobs).write(m_folder / "seg.dcm");
        return m_folder / "seg.dcm";
    }
    test::TemporaryFolder m_folder;
};

TEST_F(SegmentationFiles, EveryKindLandsOnItsSamplesOfATiltedVolume) {
    const Lattice lattice = tilted({11, 9, 5});
    std::mt19937 random(4);
    std::vector<int> values(2 * lattice.size().count());
    for (int &value : values)
        value = int(random() % 201);
    const auto valueOf = [&](int segment, int i, int j, int k) {
        return values[std::size_t(std::max(segment, 1) - 1) * lattice.size().count() +
                      lattice.size().offsetOf(i, j, k)];
    };
    const auto expect = [&](const test::SegmentationKnobs &knobs, auto shareOf) {
        const Segmentation loaded = segment::loadSegmentation(write(knobs), volumeOn(lattice));
        EXPECT_TRUE(loaded.warnings.empty());
        EXPECT_EQ(loaded.title, "Organs");
        ASSERT_EQ(loaded.segments.size(), 2U);
        EXPECT_EQ(loaded.segments[0].name, "liver");
        EXPECT_EQ(loaded.segments[1].type.meaning, "spleen");
        for (int s = 0; s < 2; ++s)
            for (int k = 0; k < 5; ++k)
                for (int j = 0; j < 9; ++j)
                    for (int i = 0; i < 11; ++i)
                        ASSERT_EQ(loaded.segments[std::size_t(s)].coverage->at({i, j, k}),
                                  shareOf(s + 1, i, j, k));
    };
    const std::vector<std::string> labels{"liver", "spleen"};
    expect({"BINARY",
            labels,
            lattice,
            [&](int s, int i, int j, int k) { return valueOf(s, i, j, k) > 120; },
            {}},
           [&](int s, int i, int j, int k) { return valueOf(s, i, j, k) > 120 ? 255 : 0; });
    expect({"FRACTIONAL", labels, lattice, valueOf, {}}, [&](int s, int i, int j, int k) {
        return int(std::lround(255.0 * valueOf(s, i, j, k) / 200.0));
    });
    expect({"LABELMAP",
            labels,
            lattice,
            [&](int, int i, int j, int k) { return valueOf(1, i, j, k) % 3; },
            {}},
           [&](int s, int i, int j, int k) { return valueOf(1, i, j, k) % 3 == s ? 255 : 0; });
}

TEST_F(SegmentationFiles, OtherLatticesAreSaid) {
    const Lattice lattice = tilted({11, 9, 5});
    const test::SegmentationKnobs knobs{
        "BINARY", {"liver"}, lattice, [](int, int, int, int) { return 1; }, {}};
    const Volume finer = volumeOn(
        Lattice::make({40, 40, 40}, {glm::dvec3(-12.0, 18.0, 26.0)},
                      {glm::dvec3(0.3, 0, 0), glm::dvec3(0, 0.3, 0), glm::dvec3(0, 0, 0.5)}));
    const Segmentation loaded = segment::loadSegmentation(write(knobs), finer);
    double farthest = 0.0;
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 9; ++j)
            for (int i = 0; i < 11; ++i) {
                const glm::dvec3 at = lattice.patient(VoxelIndex{i, j, k}).mm;
                const glm::dvec3 nearest = glm::round(finer.lattice().voxel({at}).v);
                const VoxelIndex n{int(nearest.x), int(nearest.y), int(nearest.z)};
                if (finer.lattice().contains(n))
                    farthest = std::max(farthest, glm::distance(at, finer.lattice().patient(n).mm));
            }
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_EQ(loaded.warnings[0], because::segmentsBetweenSamples(fmt::format("{:.3g}", farthest)));
    // The same samples, beside those of the volume by 3 mm along and 4 mm across the slices.
    const auto moved = [](glm::dvec3 byMm) {
        return Lattice::make({8, 8, 8}, {byMm},
                             {glm::dvec3(10, 0, 0), glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 10)});
    };
    const test::SegmentationKnobs beside{
        "BINARY", {"liver"}, moved({3.0, 0.0, 4.0}), [](int, int, int, int) { return 1; }, {}};
    EXPECT_EQ(segment::loadSegmentation(write(beside), volumeOn(moved({0, 0, 0}))).warnings,
              std::vector<task::Reason>{because::segmentsBetweenSamples("5")});
    // Samples with slices of twice the thickness coincide with every second one.
    const test::SegmentationKnobs thick{
        "BINARY",
        {"liver"},
        Lattice::make({8, 8, 4}, {glm::dvec3(0.0)},
                      {glm::dvec3(10, 0, 0), glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 20)}),
        [](int, int, int, int) { return 1; },
        {}};
    EXPECT_EQ(segment::loadSegmentation(write(thick), volumeOn(moved({0, 0, 0}))).warnings,
              std::vector<task::Reason>{because::segmentsResampled});
    // By less than a twentieth of a step: the samples get the values of their pixels.
    EXPECT_TRUE(segment::loadSegmentation(write(beside), volumeOn(moved({3.4, 0.4, 3.6})))
                    .warnings.empty());
}

TEST_F(SegmentationFiles, WhatDoesNotBelongIsRefusedWithItsReason) {
    const Lattice lattice = tilted({8, 8, 4});
    test::SegmentationKnobs knobs{
        "BINARY", {"liver"}, lattice, [](int, int, int, int) { return 1; }, {}};
    const fs::path file = m_folder / "seg.dcm";
    const auto reasonAfter = [&](const std::function<void(DicomWriter &)> &change) {
        DicomWriter w = test::segmentationFile(knobs);
        change(w);
        w.write(file);
        return reasonOf(file, volumeOn(lattice));
    };
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put({0x0020, 0x000D}, "UI", "1.2.3");
              }),
              because::belongsToAnotherStudy);
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put({0x0020, 0x0052}, "UI", "1.2.3");
              }),
              because::hasAnotherFrameOfReference);
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put({0x0062, 0x0001}, "CS", "SURFACE");
              }),
              because::unknownSegmentationType("SURFACE"));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.remove({0x0062, 0x0002});
              }),
              because::hasNoSegments);
    EXPECT_EQ(
        reasonAfter([](DicomWriter &w) {
            w.putSequence({0x0062, 0x0002}, {test::segmentItem(1, "a"), test::segmentItem(1, "b")});
        }),
        because::describesSegmentTwice(1));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.putSequence({0x0062, 0x0002}, {test::segmentItem(2, "a")});
              }),
              because::frameHasUnknownSegment(1));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.putSequence({0x5200, 0x9229}, {DicomWriter()});
              }),
              because::frameHasNoPlace);
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.putShort({0x0028, 0x0100}, 4);
              }),
              because::maskHasOtherBits(4, 1));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put(DicomWriter::pixelData, "OB", std::string(16, '\1'));
              }),
              because::pixelsTruncatedTo(128, 256));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put({0x0028, 0x0008}, "IS", "99999999");
              }),
              because::announcesTooManyFrames(99999999));
    EXPECT_EQ(reasonAfter([](DicomWriter &w) {
                  w.put({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.2");
              }),
              because::isNoSegmentation);
    // Elsewhere: in the same space, but beside the volume.
    knobs.lattice = Lattice::make({8, 8, 4}, {glm::dvec3(500.0, 0, 0)},
                                  {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)});
    EXPECT_EQ(reasonAfter([](DicomWriter &) {}), because::noSegmentInTheVolume);
}

TEST_F(SegmentationFiles, StructureSetsAreFilledOnTheVolumesSamples) {
    const Lattice lattice = Lattice::centred({20, 20, 6}, {1.0, 1.0, 2.0});
    std::vector<std::vector<glm::dvec3>> square, hole;
    for (int k = 1; k < 4; ++k) {
        const double at = lattice.patient(VoxelIndex{0, 0, k}).mm.z;
        square.push_back({{-5, -5, at}, {5, -5, at}, {5, 5, at}, {-5, 5, at}});
        hole.push_back({{-5, -5, at}, {5, -5, at}, {5, 5, at}, {-5, 5, at}});
        hole.push_back({{-2, -2, at}, {2, -2, at}, {2, 2, at}, {-2, 2, at}});
    }
    const fs::path file = m_folder / "rt.dcm";
    test::structureSetFile({{"square", square}, {"frame", hole}, {"empty", {}}}).write(file);
    const Segmentation loaded = segment::loadSegmentation(file, volumeOn(lattice));
    ASSERT_EQ(loaded.segments.size(), 2U);
    EXPECT_NEAR(loaded.segments[0].volumeMm3, 600.0, 1e-9);
    EXPECT_NEAR(loaded.segments[1].volumeMm3, 600.0 - 96.0, 1e-9);
    ASSERT_TRUE(loaded.segments[0].color);
    EXPECT_NEAR(loaded.segments[0].color->y, 128.0 / 255.0, 1e-12);
    EXPECT_TRUE(loaded.warnings.empty());
    // Its frame of reference stands only with its structures.
    DicomWriter other = test::structureSetFile({{"square", square}});
    DicomWriter region;
    region.put({0x3006, 0x0022}, "IS", "1");
    region.put({0x3006, 0x0024}, "UI", "1.2.3");
    other.putSequence({0x3006, 0x0020}, {region});
    other.write(file);
    EXPECT_EQ(reasonOf(file, volumeOn(lattice)), because::hasAnotherFrameOfReference);
    // A long contour: its text has more than 128 KiB.
    std::vector<glm::dvec3> many;
    for (int n = 0; n < 9000; ++n) {
        const double angle = 2.0 * 3.14159265358979 * n / 9000.0;
        many.emplace_back(6.0 * std::cos(angle), 6.0 * std::sin(angle), square[0][0].z);
    }
    test::structureSetFile({{"circle", {many}}}).write(file, {.isImplicit = true});
    DicomWriter::Form implicit;
    implicit.syntax = "1.2.840.10008.1.2";
    implicit.isImplicit = true;
    test::structureSetFile({{"circle", {many}}}).write(file, implicit);
    EXPECT_NEAR(segment::loadSegmentation(file, volumeOn(lattice)).segments.at(0).volumeMm3,
                3.14159265 * 36.0 * 2.0, 0.3);
}

// A structure of squares around the axis, at these slices of a lattice.
test::StructureKnobs squares(const std::string &name, const Lattice &lattice,
                             const std::vector<double> &slices) {
    test::StructureKnobs structure{name, {}};
    for (const double slice : slices) {
        std::vector<glm::dvec3> &square = structure.contours.emplace_back();
        for (const auto &[i, j] : {std::pair(4.5, 4.5), {14.5, 4.5}, {14.5, 14.5}, {4.5, 14.5}})
            square.push_back(lattice.patient(volume::VoxelPoint{{i, j, slice}}).mm);
    }
    return structure;
}

TEST_F(SegmentationFiles, ContoursBetweenTheSlicesAreSaid) {
    const Lattice lattice = Lattice::centred({20, 20, 6}, {1.0, 1.0, 2.0});
    const fs::path file = m_folder / "rt.dcm";
    const auto warningsOf = [&](const std::vector<test::StructureKnobs> &structures,
                                const Lattice &on) {
        test::structureSetFile(structures).write(file);
        return segment::loadSegmentation(file, volumeOn(on)).warnings;
    };
    using Reasons = std::vector<task::Reason>;
    const auto between = [](const char *mm, const std::string &names) {
        return Reasons{because::contoursBetweenSlices(mm, names)};
    };
    // 0.04 of a slice is 0.08 mm: the contours are on the slices.
    EXPECT_EQ(
        warningsOf({squares("on", lattice, {1, 2, 3}), squares("half", lattice, {1.5, 2.5, 3.5}),
                    squares("near", lattice, {1.04, 2.04, 3.04}),
                    squares("between", lattice, {1.25, 2.25, 3.25})},
                   lattice),
        between("1", "half, between"));
    EXPECT_TRUE(warningsOf({squares("near", lattice, {1.04, 2.04, 3.04})}, lattice).empty());
    // Many names are cut short. Contours outside the volume do not count.
    std::vector<test::StructureKnobs> many;
    std::string names;
    for (int n = 0; n < 7; ++n) {
        many.push_back(squares("part " + std::to_string(n), lattice, {1.5, 2.5, 3.25}));
        if (n < 5)
            names += "part " + std::to_string(n) + ", ";
    }
    names += "\u2026";
    many.push_back(squares("outside", lattice, {20.5, 21.5}));
    Reasons expected = between("1", names);
    expected.push_back(because::segmentNotInTheVolume("outside"));
    EXPECT_EQ(warningsOf(many, lattice), expected);
    // Slices of 0.5 mm at odd hundredths, and contours with one decimal: only rounding.
    const Lattice thin = Lattice::centred({20, 20, 6}, {1.0, 1.0, 0.5});
    const auto rounded = squares("rounded", thin, {1.1, 2.1, 3.1});
    EXPECT_TRUE(warningsOf({rounded}, thin).empty());
    // The same with more decimals is an offset.
    auto exact = rounded;
    exact.contours.front().front().x += 0.0023;
    EXPECT_EQ(warningsOf({exact}, thin), between("0.05", "rounded"));
    // The slices of a tilted scan are beside each other.
    const Lattice slanted = tilted({20, 20, 6});
    EXPECT_TRUE(warningsOf({squares("on", slanted, {1, 2, 3})}, slanted).empty());
    const segment::Segmentation loaded = segment::loadSegmentation(file, volumeOn(slanted));
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 20; ++i) {
                const bool isInside = k >= 1 && k <= 3 && std::min(i, j) > 4 && std::max(i, j) < 15;
                // Ten digits of the coordinates are kept.
                EXPECT_NEAR(loaded.segments.at(0).coverage->at({i, j, k}), isInside ? 255 : 0, 1);
            }
    // Half of 2 mm along the normal of slices that are tilted by atan(0.45 / 0.6).
    EXPECT_EQ(warningsOf({squares("half", slanted, {1.5, 2.5, 3.5})}, slanted),
              between("1", "half"));
}

TEST_F(SegmentationFiles, LabelVolumesHaveNamesAndColorsOfSlicer) {
    const Lattice lattice = tilted({6, 5, 4});
    std::vector<std::int16_t> labels(lattice.size().count());
    for (std::size_t n = 0; n < labels.size(); ++n)
        labels[n] = std::int16_t(n % 4 == 3 ? 300 : n % 4);
    const Volume stored(lattice, labels, volume::ValueUnit::none);
    volume::writeNrrd(m_folder / "atlas.nrrd", stored, volume::NrrdEncoding::gzip, {},
                      {{"Segment0_Name", "left\nkidney"},
                       {"Segment0_LabelValue", "300"},
                       {"Segment0_Color", "0.25 0.5 1"},
                       {"Segment1_Name", "duplicate"},
                       {"Segment1_LabelValue", "300"}});
    const Segmentation loaded =
        segment::loadSegmentation(m_folder / "atlas.nrrd", volumeOn(lattice));
    ASSERT_EQ(loaded.segments.size(), 3U);
    EXPECT_EQ(loaded.segments[0].name, "Segment 1");
    EXPECT_EQ(loaded.segments[2].name, "left kidney");
    EXPECT_EQ(loaded.segments[2].color, glm::dvec3(0.25, 0.5, 1.0));
    EXPECT_EQ(dice(*loaded.segments[2].coverage, stored, 300.0), 1.0);
    // A volume of one label is named after its file.
    for (std::int16_t &label : labels)
        label = label == 300 ? 1 : 0;
    volume::writeNrrd(m_folder / "spleen.nrrd", Volume(lattice, labels, volume::ValueUnit::none));
    EXPECT_EQ(
        segment::loadSegmentation(m_folder / "spleen.nrrd", volumeOn(lattice)).segments.at(0).name,
        "spleen");
    // An image is no volume of labels.
    volume::writeNrrd(
        m_folder / "image.nrrd",
        Volume(lattice, std::vector<float>(labels.size(), 0.5F), volume::ValueUnit::none));
    EXPECT_EQ(reasonOf(m_folder / "image.nrrd", volumeOn(lattice)), because::isNoLabelVolume);
}

TEST(SegmentSet, GivesEverySegmentAnotherName) {
    const Lattice lattice = tilted({2, 2, 2});
    const auto one = [](const char *name) {
        Segmentation made;
        made.title = std::string("file of ") + name;
        segment::Segment segment;
        segment.name = name;
        segment.coverage = std::make_shared<const Coverage>();
        made.segments.push_back(segment);
        return made;
    };
    const auto first = segment::SegmentSet(lattice).with(one("liver"));
    const auto all = first->with(one("liver"))->with(one("spleen"))->with(one("liver"));
    EXPECT_NE(all->find("liver"), nullptr);
    EXPECT_NE(all->find("liver (2)"), nullptr);
    EXPECT_NE(all->find("liver (3)"), nullptr);
    ASSERT_NE(all->fileOf("spleen"), nullptr);
    EXPECT_EQ(all->fileOf("spleen")->title, "file of spleen");
    EXPECT_EQ(all->fileOf("nose"), nullptr);
    EXPECT_EQ(first->find("spleen"), nullptr); // a set does not change
    // Within one file, too.
    Segmentation two = one("liver (2)");
    two.segments.push_back(two.segments.front());
    const auto more = first->with(two);
    EXPECT_NE(more->find("liver (2)"), nullptr);
    EXPECT_NE(more->find("liver (2) (2)"), nullptr);
    EXPECT_NE(more->find("liver (2)"), more->find("liver (2) (2)"));
}

// A hundred bad files of each kind: each is read, or refused with a reason, and crashes no decoder.
TEST_F(SegmentationFiles, AHundredBadFilesAreReadOrRefused) {
    const Lattice lattice = Lattice::centred({8, 8, 4}, {1.0, 1.0, 1.0});
    const DicomWriter segmentation = test::segmentationFile(
        {"BINARY", {"a", "b"}, lattice, [](int, int i, int, int) { return i & 1; }, {}});
    const DicomWriter structures =
        test::structureSetFile({{"a", {{{0, 0, 0.5}, {3, 0, 0.5}, {3, 3, 0.5}}}},
                                {"b", {{{0, 0, 1.5}, {2, 0, 1.5}, {2, 2, 1.5}}}}});
    int refused = 0, count = 0;
    std::set<std::string> reasons;
    const auto tryFile = [&](const DicomWriter &w, std::size_t cut) {
        const fs::path file = m_folder / ("bad" + std::to_string(++count) + ".dcm");
        std::string bytes = w.file({});
        bytes.resize(std::min(bytes.size(), cut));
        test::writeText(file, bytes);
        try {
            segment::loadSegmentation(file, volumeOn(lattice));
        } catch (const task::Error &error) {
            ++refused;
            EXPECT_FALSE(error.reason().english().empty());
            EXPECT_NE(error.reason(), because::decoderCrashed) << count;
            EXPECT_NE(error.reason(), because::decoderBrokeItsConfinement) << count;
            EXPECT_NE(error.reason(), because::implausibleAnswer) << count;
            reasons.insert(error.reason().english());
        }
    };
    const std::array<std::string, 4> values{"", "x", "-1", "99999999999999999999"};
    const std::size_t whole = std::size_t(1) << 30;
    for (const DicomWriter &base : {segmentation, structures})
        for (const DicomWriter::Tag &tag : {DicomWriter::Tag{0x0008, 0x0016},
                                            {0x0020, 0x000D},
                                            {0x0028, 0x0002},
                                            {0x0028, 0x0008},
                                            {0x0028, 0x0010},
                                            {0x0028, 0x0011},
                                            {0x0028, 0x0100},
                                            {0x0028, 0x0101},
                                            {0x0028, 0x0102},
                                            {0x0028, 0x0103},
                                            {0x0062, 0x0001},
                                            {0x0062, 0x0002},
                                            {0x5200, 0x9229},
                                            {0x5200, 0x9230},
                                            {0x7FE0, 0x0010},
                                            {0x3006, 0x0020},
                                            {0x3006, 0x0039},
                                            {0x3006, 0x0080}}) {
            if (!base.has(tag))
                continue;
            DicomWriter removed = base;
            removed.remove(tag);
            tryFile(removed, whole);
            for (const std::string &value : values) {
                DicomWriter changed = base;
                changed.put(tag, "LO", value);
                tryFile(changed, whole);
            }
            DicomWriter empty = base;
            empty.putSequence(tag, {});
            tryFile(empty, whole);
            DicomWriter nested = base;
            nested.putSequence(tag, {DicomWriter(), base});
            tryFile(nested, whole);
        }
    for (const DicomWriter &base : {segmentation, structures}) {
        const std::size_t size = base.file({}).size();
        for (int part = 1; part < 30; ++part)
            tryFile(base, size * std::size_t(part) / 30);
    }
    for (const char *const numbers :
         {"", "1\\2", "1\\2\\3", "1\\2\\x", "1e400\\2\\3\\4\\5\\6\\7\\8\\9",
          "nan\\nan\\nan\\1\\2\\3\\4\\5\\6", "1\\2\\3\\\\\\\\4\\5\\6"}) {
        DicomWriter contour = test::contourItem({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
        contour.put({0x3006, 0x0050}, "DS", numbers);
        DicomWriter of;
        of.put({0x3006, 0x0084}, "IS", "1");
        of.putSequence({0x3006, 0x0040}, {contour});
        DicomWriter changed = structures;
        changed.putSequence({0x3006, 0x0039}, {of});
        tryFile(changed, whole);
    }
    EXPECT_GE(count, 200);
    EXPECT_GE(refused, 120);
    EXPECT_GE(reasons.size(), 12U);
    std::printf("%d bad files, %d refused for %zu reasons\n", count, refused, reasons.size());
}

} // namespace
} // namespace pellucid
