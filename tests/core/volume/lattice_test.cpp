// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/task/error.h"
#include "core/volume/lattice.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using volume::Lattice;

TEST(Lattice, ConvertsBackAndForthOnATiltedGrid) {
    const Lattice lattice = test::tiltedLattice({10, 20, 30}, {0.5, 0.7, 3.0}, 18.5);
    for (const glm::dvec3 v :
         {glm::dvec3(0, 0, 0), glm::dvec3(9, 19, 29), glm::dvec3(-3.5, 100, 2.25)})
        EXPECT_LT(glm::distance(lattice.voxel(lattice.patient(volume::VoxelPoint{v})).v, v), 1e-12);
}

TEST(Lattice, TiltIsTheAngleBetweenStackAndNormal) {
    const Lattice lattice = test::tiltedLattice({8, 8, 8}, {1, 1, 4}, 18.5);
    EXPECT_NEAR(lattice.shearRad() * 180.0 / 3.14159265358979, 18.5, 1e-9);
    EXPECT_NEAR(lattice.sliceDistanceMm(), 4.0, 1e-12);
    EXPECT_NEAR(lattice.cellVolumeMm3(), 4.0, 1e-12);
}

TEST(Lattice, RadiusIsHalfTheLongestDiagonal) {
    EXPECT_NEAR(Lattice::centred({3, 4, 12}, {1, 1, 1}).radiusMm(), 6.5, 1e-12);
    // A sheared box has four different diagonals; the longest counts.
    const Lattice sheared =
        Lattice::make({2, 2, 2}, {}, {glm::dvec3(1, 0, 0), {1, 1, 0}, {0, 0, 1}});
    EXPECT_NEAR(sheared.radiusMm(), 0.5 * std::sqrt(16.0 + 4.0 + 4.0), 1e-12);
}

TEST(Lattice, RefusesStepsThatSpanNoVolume) {
    EXPECT_THROW(Lattice::make({2, 2, 2}, {}, {glm::dvec3(1, 0, 0), {2, 0, 0}, {0, 0, 1}}),
                 task::Error);
    EXPECT_THROW(Lattice::make({2, 2, 2}, {}, {glm::dvec3(0, 0, 0), {0, 1, 0}, {0, 0, 1}}),
                 task::Error);
    EXPECT_THROW(Lattice::make({0, 2, 2}, {}, {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}),
                 task::Error);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(
        Lattice::make({2, 2, 2}, {{nan, 0, 0}}, {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}),
        task::Error);
}

TEST(Lattice, AcceptsHugeAndTinySpacings) {
    EXPECT_NO_THROW(Lattice::centred({2, 2, 2}, {1e-6, 1e-6, 1e-6}));
    EXPECT_NO_THROW(Lattice::centred({2, 2, 2}, {1e6, 1e6, 1e6}));
}

TEST(GridSize, SamplesAreOrderedColumnsFirst) {
    const volume::GridSize size{3, 4, 5};
    std::size_t next = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                EXPECT_EQ(size.offsetOf(i, j, k), next++);
    EXPECT_EQ(next, size.count());
    // Offsets need more than 32 bits.
    EXPECT_EQ((volume::GridSize{4096, 4096, 4096}.offsetOf(1, 2, 4000)), 67108872193U);
}

TEST(Lattice, FillsTheBoxOfALatticeWithOtherSlices) {
    const Lattice fine =
        Lattice::make({10, 20, 64}, {{1.0, 2.0, 3.0}},
                      {glm::dvec3(0.7, 0.0, 0.0), {0.0, 0.7, 0.0}, {0.1, 0.2, 1.0}});
    const glm::dvec3 step = fine.step(2);
    const auto coarse = [&](glm::dvec3 shift) {
        return Lattice::make({10, 20, 8}, {fine.origin().mm + 3.5 * step + shift},
                             {fine.step(0), fine.step(1), 8.0 * step});
    };
    EXPECT_TRUE(coarse({}).fillsSameBox(fine));
    EXPECT_TRUE(fine.fillsSameBox(coarse({0.0, 0.0, 0.05})));
    EXPECT_FALSE(fine.fillsSameBox(coarse({0.0, 0.0, 0.2})));
    EXPECT_FALSE(fine.fillsSameBox(fine.cropped({{0, 0, 0}, {10, 20, 63}})));
}

TEST(Lattice, CroppingKeepsPositions) {
    const Lattice lattice = test::tiltedLattice({10, 20, 30}, {0.5, 0.7, 3.0}, 18.5);
    const Lattice part = lattice.cropped({{2, 3, 4}, {5, 7, 9}});
    EXPECT_EQ(part.size(), (volume::GridSize{3, 4, 5}));
    EXPECT_LT(glm::distance(part.patient(volume::VoxelIndex{1, 1, 1}).mm,
                            lattice.patient(volume::VoxelIndex{3, 4, 5}).mm),
              1e-12);
}

} // namespace
} // namespace pellucid
