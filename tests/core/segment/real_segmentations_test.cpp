// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations by other programs, against the same masks written as volumes by yet another.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/segment/segmentation.h"
#include "tests/support/dice.h"
#include "tests/support/test_data.h"

namespace pellucid {
namespace {

namespace fs = std::filesystem;
using segment::Segmentation;
using test::dice;
using volume::Lattice;
using volume::Volume;

TEST(RealSegmentations, LandOnTheirVoxels) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path folder = test::testData() / "seg_dcmqi";
    const auto catalogue = dicom::scan({folder / "ct-3slice"});
    const Volume ct = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const Segmentation liver = segment::loadSegmentation(folder / "liver.dcm", ct);
    ASSERT_EQ(liver.segments.size(), 1U);
    EXPECT_EQ(liver.segments[0].name, "Liver");
    EXPECT_TRUE(liver.warnings.empty());
    EXPECT_EQ(
        dice(*liver.segments[0].coverage, decoding::readVolumeFile(folder / "liver_seg.nrrd"), 1.0),
        1.0);
    // Five segments in three volumes, because they overlap.
    const Segmentation parts = segment::loadSegmentation(folder / "partial_overlaps.dcm", ct);
    ASSERT_EQ(parts.segments.size(), 5U);
    std::vector<bool> isFound(5);
    for (const char *const file :
         {"partial_overlaps-1.nrrd", "partial_overlaps-2.nrrd", "partial_overlaps-3.nrrd"}) {
        const Volume labels = decoding::readVolumeFile(folder / file);
        for (int s = 0; s < 5; ++s)
            if (dice(*parts.segments[std::size_t(s)].coverage, labels, s + 1.0) == 1.0)
                isFound[std::size_t(s)] = true;
    }
    EXPECT_EQ(isFound, std::vector<bool>(5, true));
    // The same mask as a volume: interpolation is not needed.
    const Segmentation asLabels = segment::loadSegmentation(folder / "liver_seg.nrrd", ct);
    EXPECT_TRUE(asLabels.warnings.empty());
    EXPECT_EQ(*asLabels.segments.at(0).coverage, *liver.segments[0].coverage);
}

TEST(RealSegmentations, ALabelMapIsThatOfItsVolume) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path folder = test::testData() / "seg_dcmqi";
    for (const auto &[file, truth] :
         {std::pair("sparse-labelmap-noppv.dcm", "sparse_labelmap_noppv_seg.nrrd"),
          std::pair("sparse-labelmap-ppv5.dcm", "sparse_labelmap_ppv5_seg.nrrd")}) {
        const Volume labels = decoding::readVolumeFile(folder / truth);
        const Segmentation loaded = segment::loadSegmentation(folder / file, labels);
        ASSERT_EQ(loaded.segments.size(), 1U) << file;
        EXPECT_TRUE(loaded.warnings.empty()) << file;
        EXPECT_EQ(dice(*loaded.segments[0].coverage, labels, 1.0), 1.0) << file;
    }
}

// By highdicom, on the CT of another folder.
TEST(RealSegmentations, FractionalAndOverlappingOnesFit) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path folder = test::testData() / "seg_highdicom_ct";
    const auto catalogue = dicom::scan({folder});
    const Volume ct = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const Segmentation single =
        segment::loadSegmentation(folder / "seg_image_ct_binary_single_frame.dcm", ct);
    ASSERT_EQ(single.segments.size(), 1U);
    EXPECT_TRUE(single.warnings.empty());
    // The other four belong to a CT of 16 x 16 pixels with slices of 1.25 mm.
    const Volume small =
        Volume(Lattice::make({16, 16, 3}, {glm::dvec3(-125.0, -128.100006, 103.019997)},
                             {glm::dvec3(0.488281, 0, 0), glm::dvec3(0, 0.488281, 0),
                              glm::dvec3(0, 0, 1.25)}),
               std::vector<std::int16_t>(768, 0), volume::ValueUnit::none);
    const Segmentation binary =
        segment::loadSegmentation(folder / "seg_image_ct_binary.dcm", small);
    const Segmentation asFractions =
        segment::loadSegmentation(folder / "seg_image_ct_binary_fractional.dcm", small);
    EXPECT_TRUE(binary.warnings.empty());
    EXPECT_EQ(*binary.segments.at(0).coverage, *asFractions.segments.at(0).coverage);
    const Segmentation overlap =
        segment::loadSegmentation(folder / "seg_image_ct_binary_overlap.dcm", small);
    EXPECT_EQ(overlap.segments.size(), 2U);
    const Segmentation fractional =
        segment::loadSegmentation(folder / "seg_image_ct_true_fractional.dcm", small);
    std::set<int> shares(fractional.segments.at(0).coverage->shares.begin(),
                         fractional.segments.at(0).coverage->shares.end());
    shares.erase(0);
    shares.erase(255);
    EXPECT_FALSE(shares.empty());
}

} // namespace
} // namespace pellucid
