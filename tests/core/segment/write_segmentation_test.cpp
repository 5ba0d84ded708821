// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/write_segmentation.h"

#include <filesystem>
#include <random>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/segment/reasons.h"
#include "core/task/error.h"
#include "tests/support/segmentation_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {
namespace {

namespace fs = std::filesystem;
using segment::Segmentation;
using test::tilted;
using test::volumeOn;
using volume::Coverage;
using volume::Lattice;

class WrittenSegmentation : public testing::Test {
protected:
    test::TemporaryFolder m_folder;
};

// Writes segments, checks the file with DCMTK's own reader, and reads it again.
TEST_F(WrittenSegmentation, RoundTripsBitForBit) {
    const Lattice lattice = tilted({13, 10, 6});
    std::mt19937 random(9);
    for (const bool isBinary : {true, false}) {
        std::vector<segment::Segment> segments;
        for (int n = 0; n < 3; ++n) {
            segment::Segment segment;
            segment.name = n == 0 ? "left atrium \xE5\xB7\xA6" : "part " + std::to_string(n);
            segment.color = glm::dvec3(0.9, 0.2 * n, 0.3);
            if (n == 1)
                segment.type = {"39607008", "SCT", "Lung"};
            Coverage coverage{{{n, 1, 1}, {12, 9, 5 - n}}, {}};
            coverage.shares.resize(coverage.box.size().count());
            for (std::uint8_t &share : coverage.shares)
                share = isBinary ? random() % 2 * 255 : random();
            coverage.shares.front() = coverage.shares.back() = 255; // the box is the smallest
            segment.coverage = std::make_shared<const Coverage>(coverage);
            segments.push_back(segment);
        }
        const fs::path file = m_folder / "written.dcm";
        segment::SegmentationLabels labels;
        labels.study.studyUid = test::knobsRoot + "2";
        labels.study.patientName = "Roundtrip^Jane";
        labels.frameOfReferenceUid = test::knobsRoot + "4";
        segment::writeSegmentation(file, segments, lattice, labels);

        DcmSegmentation *opened = nullptr;
        ASSERT_TRUE(DcmSegmentation::loadFile(file.string().c_str(), opened).good());
        const std::unique_ptr<DcmSegmentation> byDcmtk(opened);
        EXPECT_EQ(byDcmtk->getNumberOfSegments(), 3U);
        OFString name;
        EXPECT_TRUE(byDcmtk->getPatient().getPatientName(name).good());
        EXPECT_EQ(name, "Roundtrip^Jane");
        OFVector<size_t> frames;
        byDcmtk->getFramesForSegment(2, frames);
        EXPECT_EQ(frames.size(), 3U); // slices 1 to 3

        const Segmentation read = segment::loadSegmentation(file, volumeOn(lattice));
        ASSERT_EQ(read.segments.size(), 3U);
        for (std::size_t n = 0; n < 3; ++n) {
            EXPECT_EQ(read.segments[n].name, segments[n].name);
            EXPECT_LT(glm::length(*read.segments[n].color - *segments[n].color), 2e-3);
            for (int k = 0; k < 6; ++k)
                for (int j = 0; j < 10; ++j)
                    for (int i = 0; i < 13; ++i)
                        ASSERT_EQ(read.segments[n].coverage->at({i, j, k}),
                                  segments[n].coverage->at({i, j, k}));
        }
        EXPECT_EQ(read.segments[1].type.meaning, "Lung");
    }
}

TEST_F(WrittenSegmentation, LabelsRoundTripAndRefuseOverlaps) {
    const Lattice lattice = tilted({8, 7, 5});
    const auto boxed = [](const char *name, volume::VoxelBox box) {
        segment::Segment segment;
        segment.name = name;
        segment.coverage = std::make_shared<const Coverage>(
            Coverage{box, std::vector<std::uint8_t>(box.size().count(), 255)});
        return segment;
    };
    const std::vector<segment::Segment> apart{boxed("a", {{0, 0, 0}, {3, 7, 5}}),
                                              boxed("b", {{3, 0, 0}, {8, 7, 2}})};
    segment::writeLabels(m_folder / "labels.nrrd", apart, lattice);
    const Segmentation read =
        segment::loadSegmentation(m_folder / "labels.nrrd", volumeOn(lattice));
    ASSERT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.segments[1].name, "b");
    for (std::size_t n = 0; n < 2; ++n)
        EXPECT_EQ(*read.segments[n].coverage, *apart[n].coverage);
    try {
        segment::writeLabels(m_folder / "overlap.nrrd",
                             {apart[0], boxed("c", {{2, 2, 2}, {4, 4, 4}})}, lattice);
        ADD_FAILURE() << "overlapping labels were written";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::segmentsOverlap("a", "c"));
    }
    EXPECT_FALSE(fs::exists(m_folder / "overlap.nrrd"));
}

} // namespace
} // namespace pellucid
