// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "core/field/energy_marginals.h"
#include "core/field/line_integral_bound.h"
#include "core/field/slab_products.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

double sum(const std::vector<double> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(EnergyMarginals, OnePointHasAllTheEnergyAtItsPlace) {
    const auto lattice = volume::Lattice::centred({21, 21, 21}, {1, 1, 2});
    std::vector<float> samples(lattice.size().count(), 0.0F);
    samples[(std::size_t(10) * 21 + 10) * 21 + 16] = 3.0F; // 6 mm from the centre along x
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const auto energy = field::energyMarginals(field, lattice.bounds());
    const field::EnergySpread &spread = *energy.spread;
    EXPECT_DOUBLE_EQ(energy.axis[0][16], 1.0);
    EXPECT_DOUBLE_EQ(energy.axis[1][10], 1.0);
    EXPECT_DOUBLE_EQ(spread.radiusMm, 6.0);
    // The distance is 6 mm along x, 6/sqrt(2) along a face diagonal and 0 along y.
    int far = 0, near = 0;
    for (const auto &shares : spread.byDistance) {
        EXPECT_NEAR(sum(shares), 1.0, 1e-12);
        far += shares.back() == 1.0 ? 1 : 0;
        near += shares.front() == 1.0 ? 1 : 0;
    }
    EXPECT_EQ(far, 1);
    EXPECT_EQ(near, 4); // y, z, and the diagonals of the face across x
}

// The projection of a uniform ball is 2 sqrt(R^2 - r^2), so peak times mass over energy is 4/3. The
// bound may be larger because blocks blur the field.
TEST(EnergyMarginals, ABallIsHardlyPeaked) {
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1, 1, 1});
    std::vector<float> samples;
    for (int k = 0; k < 64; ++k)
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i)
                samples.push_back(
                    glm::length(lattice.patient(volume::VoxelIndex{i, j, k}).mm) < 28.0 ? 1.0F
                                                                                        : 0.0F);
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const auto energy = field::energyMarginals(field, lattice.bounds());
    EXPECT_GT(energy.spread->peakedness, 4.0 / 3.0);
    EXPECT_LT(energy.spread->peakedness, 2.5);
    // The integral of P^2 is 2 pi R^4; blocks blur it.
    const double least = 9.0 / (8.0 * 3.14159265358979 * 28.0 * 28.0);
    EXPECT_LT(energy.spread->leastProjection, least);
    EXPECT_GT(energy.spread->leastProjection, 0.8 * least);
}

// The one sweep against sums sample by sample, on short and long axes.
TEST(EnergyMarginals, BlocksAreSumsOfTheirSamples) {
    for (const volume::GridSize &size :
         {volume::GridSize{1, 1, 1}, {1, 7, 2}, {9, 1, 21}, {43, 70, 5}}) {
        const auto lattice = volume::Lattice::centred(size, {1, 1, 1});
        std::vector<float> samples(size.count());
        for (std::size_t n = 0; n < samples.size(); ++n)
            samples[n] = float(n * 37 % 11);
        samples.front() = 5.0F;
        const volume::Volume volume(lattice, samples, volume::ValueUnit::none);
        const auto found = field::energyMarginals(volume, lattice.bounds());
        const std::array<std::vector<field::BlockRange>, 3> ranges{
            field::blockRanges(size.i), field::blockRanges(size.j), field::blockRanges(size.k)};
        double all = 0.0, allMass = 0.0, shares = 0.0;
        for (const float f : samples) {
            all += double(f) * double(f);
            allMass += double(f);
        }
        for (const field::Block &block : found.blocks) {
            const field::BlockRange i = ranges[0][block.at[0]], j = ranges[1][block.at[1]],
                                    k = ranges[2][block.at[2]];
            double energy = 0.0, mass = 0.0;
            for (int z = k.first; z <= k.last; ++z)
                for (int y = j.first; y <= j.last; ++y)
                    for (int x = i.first; x <= i.last; ++x) {
                        const auto f = double(
                            samples[(std::size_t(z) * size.j + std::size_t(y)) * size.i + x]);
                        energy += f * f;
                        mass += f;
                    }
            EXPECT_NEAR(double(block.energy), energy / all, 1e-6);
            EXPECT_NEAR(double(block.mass), mass / allMass, 1e-6);
            shares += double(block.energy);
        }
        EXPECT_NEAR(shares, 1.0, 1e-5);
    }
}

// A sample alone differs from its neighbours by the same along each axis, whatever the box.
TEST(EnergyMarginals, APointIsAsRoughInEveryBox) {
    const auto roughness = [](const volume::GridSize &size) {
        const auto lattice = volume::Lattice::centred(size, {1, 1, 1});
        std::vector<float> samples(size.count(), 0.0F);
        samples[size.count() / 2] = 3.0F;
        const volume::Volume volume(lattice, samples, volume::ValueUnit::none);
        const auto found = field::energyMarginals(volume, lattice.bounds());
        return found.spread->roughestView * found.massMm3 * found.massMm3 / found.energyMm3;
    };
    const double alongI = roughness({1, 1, 1});
    EXPECT_GT(alongI, 0.0);
    EXPECT_NEAR(roughness({1, 3, 1}), roughness({3, 1, 1}), 1e-9 * alongI);
    EXPECT_NEAR(roughness({1, 1, 3}), roughness({3, 1, 1}), 1e-9 * alongI);
}

// A rod along the diagonal of cells: between two layers of samples no line is longer than the
// cell's diagonal, sqrt(6) mm, and no sample is above 1, so that the rod's own line is the largest.
TEST(LargestLineIntegral, IsThatAlongARod) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 2});
    field::LayerMaxima layers;
    layers.samples = layers.columns = layers.rows = 40;
    layers.values.resize(40 * 40 * 40);
    for (int n = 0; n < 40; ++n)
        layers.at(n, n, n) = 1.0F;
    const double length = 40.0 * std::sqrt(6.0);
    EXPECT_NEAR(field::largestLineIntegral({layers, layers, layers}, 1, lattice), length,
                1e-9 * length);
}

// The same rod in haze. Seen along the rod, all of its mass falls within the shadow of one sample:
// a third of the mass has nearly all of the energy of that projection.
TEST(EnergyMarginals, ARodInHazeHasMoreOfAProjectionThanOfTheMass) {
    const auto lattice = volume::Lattice::centred({40, 40, 40}, {1, 1, 2});
    constexpr double haze = 1e-3;
    std::vector<float> samples(lattice.size().count(), float(haze));
    for (int n = 0; n < 40; ++n)
        samples[(std::size_t(n) * 40 + n) * 40 + n] = 1.0F;
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const auto energy = field::energyMarginals(field, lattice.bounds());
    const double length = 40.0 * std::sqrt(6.0), areaMm2 = 2.0 / std::sqrt(6.0);
    const double rodMm3 = 40.0 * 2.0, massMm3 = rodMm3 + haze * 2.0 * (40.0 * 40.0 * 40.0 - 40.0);
    EXPECT_NEAR(energy.massMm3, massMm3, 1e-6 * massMm3); // samples are float
    // The rod's projection is `length` over its shadow, that of the haze at most `haze * length`.
    const double rodEnergy = length * length * areaMm2, hazeEnergy = haze * length * massMm3;
    EXPECT_GE(energy.spread->peakedness,
              (1.0 - hazeEnergy / rodEnergy) / (rodMm3 / massMm3)); // 2.6
    EXPECT_TRUE(std::isfinite(energy.spread->peakedness));
}

// Rows that are computed while they are read give the same statistics as rows in memory.
TEST(EnergyMarginals, OfARampAreThoseOfItsValues) {
    const auto lattice = test::tiltedLattice({33, 21, 18}, {0.7, 0.9, 2.0}, 12);
    const volume::Field ramp =
        volume::Field(test::noiseField(lattice).values.samples(), volume::Ramp{0.2F, 1.5F})
            .within({{2, 1, 3}, {30, 20, 15}});
    const volume::VoxelBox box{{1, 1, 2}, {31, 21, 16}};
    const auto a = field::energyMarginals(ramp, box),
               b = field::energyMarginals(ramp.asVolume(), box);
    EXPECT_EQ(a.axis, b.axis);
    EXPECT_EQ(a.massMm3, b.massMm3);
    EXPECT_EQ(a.energyMm3, b.energyMm3);
    EXPECT_EQ(a.spread->roughestView, b.spread->roughestView);
    EXPECT_EQ(a.spread->peakedness, b.spread->peakedness);
    EXPECT_EQ(a.spread->byDistance, b.spread->byDistance);
    const auto slabs = field::slabProducts(ramp, box),
               others = field::slabProducts(ramp.asVolume(), box);
    for (std::size_t d = 0; d < 3; ++d)
        EXPECT_EQ(slabs[d].products, others[d].products);
    // The sums themselves, in double.
    double mass = 0.0, energy = 0.0;
    for (int k = box.lo.k; k < box.hi.k; ++k)
        for (int j = box.lo.j; j < box.hi.j; ++j)
            for (int i = box.lo.i; i < box.hi.i; ++i) {
                const double f = ramp.value({i, j, k});
                mass += f;
                energy += f * f;
            }
    const double cell = lattice.cellVolumeMm3();
    EXPECT_NEAR(a.massMm3, cell * mass, 1e-6 * cell * mass);
    EXPECT_NEAR(a.energyMm3, cell * energy, 1e-6 * cell * energy);
}

TEST(EnergyMarginals, AnEmptyFieldHasNoEnergyAnywhere) {
    const auto lattice = volume::Lattice::centred({8, 8, 8}, {1, 1, 1});
    const volume::Volume field(lattice, std::vector<float>(512, 0.0F), volume::ValueUnit::none);
    const auto energy = field::energyMarginals(field, {{4, 4, 4}, {5, 5, 5}});
    for (const auto &axis : energy.axis)
        EXPECT_EQ(sum(axis), 0.0);
    for (const auto &shares : energy.spread->byDistance)
        EXPECT_EQ(sum(shares), 0.0);
}

} // namespace
} // namespace pellucid
