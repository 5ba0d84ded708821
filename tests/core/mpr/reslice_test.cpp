// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/mpr/reslice.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using mpr::Orientation;

// Trilinear interpolation reproduces a linear function of the position exactly, on any lattice.
TEST(Reslice, ReproducesALinearFunctionOnATiltedLattice) {
    const auto lattice = test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 25);
    const auto linear = [](const glm::dvec3 &p) {
        return 3.0 + 0.5 * p.x - 2.0 * p.y + 0.25 * p.z;
    };
    std::vector<float> samples(lattice.size().count());
    std::size_t n = 0;
    for (int k = 0; k < 12; ++k)
        for (int j = 0; j < 28; ++j)
            for (int i = 0; i < 30; ++i)
                samples[n++] = float(linear(lattice.patient(volume::VoxelIndex{i, j, k}).mm));
    const volume::Volume volume(lattice, samples, volume::ValueUnit::none);
    for (const auto orientation :
         {Orientation::axial, Orientation::coronal, Orientation::sagittal}) {
        mpr::Plane plane{lattice.center(), {}, {}, 0.8, 21, 17};
        mpr::setAxes(plane, orientation);
        const auto image = mpr::reslice(volume, plane);
        int inside = 0;
        for (int r = 0; r < 17; ++r)
            for (int c = 0; c < 21; ++c) {
                const glm::dvec3 v = lattice.voxel(plane.at(c, r)).v;
                const bool within =
                    v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x <= 29 && v.y <= 27 && v.z <= 11;
                if (!within)
                    continue;
                ++inside;
                EXPECT_NEAR(image.values[r * 21 + c], linear(plane.at(c, r).mm), 1e-4);
            }
        EXPECT_GT(inside, 100);
    }
}

TEST(Reslice, OutsideTheVolumeThereIsNothing) {
    const auto field = test::noiseField(volume::Lattice::centred({4, 4, 4}, {1, 1, 1}));
    EXPECT_TRUE(std::isnan(mpr::valueAt(field.values, {{0, 0, 2.1}})));
    EXPECT_FALSE(
        std::isnan(mpr::valueAt(field.values, {{0, 0, 1.9}}))); // half a sample beyond the centre
}

TEST(Reslice, PlanesFollowTheRadiologicalConvention) {
    mpr::Plane plane{{}, {}, {}, 1.0, 11, 11};
    mpr::setAxes(plane, Orientation::axial);
    EXPECT_EQ(plane.at(0, 5).mm, glm::dvec3(-5, 0, 0)); // image left is the patient's right
    EXPECT_EQ(plane.at(5, 0).mm, glm::dvec3(0, -5, 0)); // up is anterior
    mpr::setAxes(plane, Orientation::coronal);
    EXPECT_EQ(plane.at(0, 0).mm, glm::dvec3(-5, 0, 5));
    mpr::setAxes(plane, Orientation::sagittal);
    EXPECT_EQ(plane.at(0, 0).mm, glm::dvec3(0, -5, 5)); // image left is anterior
    EXPECT_EQ(plane.pixel({{0, 2, 3}}), glm::dvec2(7, 2));
}

TEST(Reslice, ScrollingStepsFromSliceToSlice) {
    const auto lattice = test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 0);
    EXPECT_NEAR(mpr::scrollRange(lattice, Orientation::axial).stepMm, 3.0, 1e-12);
    EXPECT_NEAR(mpr::scrollRange(lattice, Orientation::sagittal).stepMm, 1.0, 1e-12);
    const auto range = mpr::scrollRange(lattice, Orientation::axial);
    EXPECT_NEAR(range.highMm - range.lowMm, 33.0, 1e-12);
}

TEST(Reslice, OneSampleFillsItsCell) {
    const volume::Volume one(volume::Lattice::centred({1, 1, 1}, {2, 2, 2}),
                             std::vector<float>{7.0F}, volume::ValueUnit::none);
    EXPECT_EQ(mpr::valueAt(one, {{0.9, -0.9, 0.9}}), 7.0F);
}

} // namespace
} // namespace pellucid
