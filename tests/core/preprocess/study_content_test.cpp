// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/study_content.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/phantom/phantom.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

using presets::BodyRegion;

volume::Volume phantomOf(phantom::Kind kind) {
    volume::Volume volume = phantom::makePhantom(
        kind, phantom::phantomLattice(kind, {.size = volume::GridSize{128, 128, 64}}));
    return volume.visit([&](auto samples) {
        // Without its name.
        volume::VolumeNotes notes;
        notes.modality = "CT";
        return volume::Volume(volume.lattice(),
                              std::vector<std::int16_t>(samples.begin(), samples.end()),
                              volume::ValueUnit::hounsfield, notes);
    });
}

// A trunk with a vertebra of marrow and dense rind, and a vessel beside it of that many HU.
volume::Volume trunk(std::int16_t vesselHu) {
    const auto lattice = volume::Lattice::centred({120, 100, 40}, {3.0, 3.0, 4.0});
    std::vector<std::int16_t> samples;
    for (int k = 0; k < 40; ++k)
        for (int j = 0; j < 100; ++j)
            for (int i = 0; i < 120; ++i) {
                const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, k}).mm;
                const double vertebra = glm::length(glm::dvec2(p.x, p.y - 60.0));
                const double vessel = glm::length(glm::dvec2(p.x - 15.0, p.y - 18.0));
                samples.push_back(vertebra < 18.0   ? 220
                                  : vertebra < 23.0 ? 700
                                  : vessel < 12.0   ? vesselHu
                                  : glm::length(glm::dvec2(p.x / 165.0, p.y / 110.0)) < 1.0
                                      ? 50
                                      : -1000);
            }
    return {lattice, samples, volume::ValueUnit::hounsfield};
}

} // namespace

TEST(StudyContent, RegionsAreSeenInTheValues) {
    EXPECT_EQ(preprocess::contentOf(phantomOf(phantom::Kind::head)).traits.regions,
              std::set{BodyRegion::head});
    const auto chest = preprocess::contentOf(phantomOf(phantom::Kind::chest)).traits.regions;
    EXPECT_TRUE(chest.contains(BodyRegion::chest)); // and some of the abdomen
    EXPECT_FALSE(chest.contains(BodyRegion::head));
    EXPECT_EQ(preprocess::contentOf(trunk(50)).traits.regions, std::set{BodyRegion::abdomen});
}

TEST(StudyContent, TheHeaderComesFirst) {
    const volume::Volume head = phantomOf(phantom::Kind::head);
    volume::VolumeNotes notes = head.notes();
    notes.bodyPart = "PELVIS";
    const volume::Volume named = head.visit([&](auto samples) {
        return volume::Volume(head.lattice(),
                              std::vector<std::int16_t>(samples.begin(), samples.end()),
                              volume::ValueUnit::hounsfield, notes);
    });
    EXPECT_EQ(preprocess::contentOf(named).traits.regions, std::set{BodyRegion::pelvis});
}

// Marrow has the values of vessels, but is no contrast medium.
TEST(StudyContent, ContrastMediumIsFound) {
    EXPECT_FALSE(preprocess::contentOf(trunk(50)).traits.hasContrast);
    EXPECT_TRUE(preprocess::contentOf(trunk(300)).traits.hasContrast);
    EXPECT_FALSE(preprocess::contentOf(phantomOf(phantom::Kind::head)).traits.hasContrast);
}

// A chest without contrast medium, whose vertebrae have the values of vessels.
TEST(StudyContent, ARealChestWithoutContrastMediumHasNone) {
    PELLUCID_NEEDS_TEST_DATA();
    const auto catalogue = dicom::scan({test::testData() / "ct_chest_philips_64"});
    const auto traits =
        preprocess::contentOf(dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume)
            .traits;
    EXPECT_FALSE(traits.hasContrast);
    EXPECT_TRUE(traits.regions.contains(BodyRegion::chest));
}

} // namespace pellucid
