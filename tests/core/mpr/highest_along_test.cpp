// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/mpr/highest_along.h"

namespace pellucid {
namespace {

using volume::GridSize;
using volume::Lattice;
using volume::Volume;
using volume::VoxelIndex;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

// A tilted lattice with two bright samples, and no values at its border.
Volume spots(const VoxelIndex &bright, const VoxelIndex &brighter) {
    const Lattice lattice = Lattice::make(
        {16, 14, 12}, {glm::dvec3(3.0, -20.0, 7.0)},
        {glm::dvec3(1.1, 0.1, 0.0), glm::dvec3(-0.1, 0.9, 0.1), glm::dvec3(0.0, 0.5, 2.5)});
    const GridSize n = lattice.size();
    std::vector<float> samples(n.count(), 1.0F);
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i)
                if (i == 0 || j == 0 || k == 0 || i + 1 == n.i || j + 1 == n.j || k + 1 == n.k)
                    samples[n.offsetOf(i, j, k)] = nothing;
    samples[n.offsetOf(bright.i, bright.j, bright.k)] = 50.0F;
    samples[n.offsetOf(brighter.i, brighter.j, brighter.k)] = 80.0F;
    return {lattice, samples, volume::ValueUnit::none};
}

TEST(HighestAlong, FindsTheBrighterOfTwoSamplesOnALine) {
    const VoxelIndex near{5, 6, 3}, far{9, 8, 8};
    const Volume volume = spots(near, far);
    const Lattice &lattice = volume.lattice();
    const glm::dvec3 a = lattice.patient(near).mm, b = lattice.patient(far).mm;
    const glm::dvec3 sight = glm::normalize(b - a);
    // Wherever on the line the click is, and whichever way the view looks.
    for (const double mm : {-200.0, 0.0, 7.0, 500.0})
        for (const double way : {1.0, -1.0}) {
            const auto found =
                mpr::highestAlong(volume, lattice.bounds(), {a + mm * sight}, way * sight);
            ASSERT_TRUE(found) << mm;
            EXPECT_EQ(*found, lattice.patient(far)) << mm;
        }
    // Within a box, or a region, that does not contain it: the other one.
    const volume::VoxelBox box{{0, 0, 0}, {16, 14, 6}};
    EXPECT_EQ(mpr::highestAlong(volume, box, {a}, sight), lattice.patient(near));
    volume::Coverage seen{box, std::vector<std::uint8_t>(box.size().count(), 255)};
    EXPECT_EQ(mpr::highestAlong(volume, lattice.bounds(), {a}, sight, &seen),
              lattice.patient(near));
    seen.shares[seen.offsetOf(near)] = 100; // less than half
    EXPECT_NE(mpr::highestAlong(volume, lattice.bounds(), {a}, sight, &seen),
              lattice.patient(near));
    // Beside the volume there is nothing.
    EXPECT_FALSE(mpr::highestAlong(volume, lattice.bounds(), {a + glm::dvec3(0.0, 0.0, 900.0)},
                                   {1.0, 0.0, 0.0}));
}

} // namespace
} // namespace pellucid
