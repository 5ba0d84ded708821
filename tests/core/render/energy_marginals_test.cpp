// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numeric>

#include "core/render/energy_marginals.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

double sum(const std::vector<double> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(EnergyMarginals, OnePointIsWhereItIs) {
    const auto lattice = volume::Lattice::centred({21, 21, 21}, {1, 1, 2});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    samples[(std::size_t(10) * 21 + 10) * 21 + 16] = 3.0F; // 6 mm right of the centre
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const auto energy = render::energyMarginals(field, lattice.bounds());
    const render::EnergySpread &spread = *energy.spread;
    EXPECT_DOUBLE_EQ(energy.axis[0][16], 1.0);
    EXPECT_DOUBLE_EQ(energy.axis[1][10], 1.0);
    EXPECT_DOUBLE_EQ(spread.radiusMm, 6.0);
    EXPECT_DOUBLE_EQ(spread.concentration, 1.0);
    // Along x the whole way, along the diagonal of a face 1/sqrt(2) of it, along y none.
    int far = 0, near = 0;
    for (const auto &shares : spread.byDistance) {
        EXPECT_NEAR(sum(shares), 1.0, 1e-12);
        far += shares.back() == 1.0 ? 1 : 0;
        near += shares.front() == 1.0 ? 1 : 0;
    }
    EXPECT_EQ(far, 1);
    EXPECT_EQ(near, 4); // y, z, and the diagonals of the face across x
    for (const double roughness : spread.roughness)
        EXPECT_DOUBLE_EQ(roughness, 1.0);
}

TEST(EnergyMarginals, SmoothFieldsAreRoughInLargePixels) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    std::vector<float> samples;
    for (int k = 0; k < 64; ++k)
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i)
                samples.push_back(float(std::cos(0.2 * i) * std::cos(0.2 * j) * std::cos(0.2 * k)));
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const auto spread = *render::energyMarginals(field, lattice.bounds()).spread;
    // Differences of a cosine have (2 sin(w/2))^2 of its energy, in steps of s samples w = 0.2 s.
    // The jump at the faces adds 0.03.
    EXPECT_NEAR(spread.roughness[0], 0.02, 0.04);
    EXPECT_LT(spread.roughness[0], spread.roughness[1]);
    EXPECT_LT(spread.roughness[1], spread.roughness[2]);
    EXPECT_NEAR(spread.roughness[3], 1.0 - std::cos(1.6), 0.2);
    EXPECT_EQ(spread.roughnessAt(0.3), spread.roughness[0]);
    EXPECT_EQ(spread.roughnessAt(3.0), spread.roughness[2]);
    EXPECT_EQ(spread.roughnessAt(100.0), spread.roughness[3]);
}

TEST(EnergyMarginals, AnEmptyFieldHasNoEnergyAnywhere) {
    const auto lattice = volume::Lattice::centred({8, 8, 8}, {1, 1, 1});
    const volume::Volume field(lattice, std::vector<float>(512, 0.0F), volume::ValueUnit::none);
    const auto energy = render::energyMarginals(field, {{4, 4, 4}, {5, 5, 5}});
    for (const auto &axis : energy.axis)
        EXPECT_EQ(sum(axis), 0.0);
    for (const auto &shares : energy.spread->byDistance)
        EXPECT_EQ(sum(shares), 0.0);
}

} // namespace
} // namespace pellucid
