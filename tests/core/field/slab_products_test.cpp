// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/field/slab_products.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

// With one slab a sample, w^T C w is the energy of the projection of the weighted field.
TEST(SlabProducts, GiveTheEnergyOfWeightedProjections) {
    const volume::GridSize size{7, 9, 11};
    const auto field = test::noiseField(volume::Lattice::centred({9, 12, 13}, {1, 1, 1}));
    const volume::VoxelBox box{{1, 2, 1}, {8, 11, 12}};
    const auto all = field::slabProducts(field.values, box);
    for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(all[std::size_t(axis)].slabs, size[axis]);
        std::vector<double> weights;
        for (int n = 0; n < size[axis]; ++n)
            weights.push_back(std::sin(1.7 * n));
        double plain = 0.0, weighted = 0.0;
        const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        for (int a = 0; a < size[u]; ++a)
            for (int b = 0; b < size[v]; ++b) {
                double sum = 0.0, weightedSum = 0.0;
                for (int n = 0; n < size[axis]; ++n) {
                    std::array<int, 3> at{};
                    at[std::size_t(axis)] = n;
                    at[std::size_t(u)] = a;
                    at[std::size_t(v)] = b;
                    const double f =
                        field.values.value({box.lo.i + at[0], box.lo.j + at[1], box.lo.k + at[2]});
                    sum += f;
                    weightedSum += weights[std::size_t(n)] * f;
                }
                plain += sum * sum;
                weighted += weightedSum * weightedSum;
            }
        EXPECT_NEAR(all[std::size_t(axis)].energy(weights), weighted / plain, 1e-6);
    }
}

TEST(SlabProducts, SlabsOfNoiseAreUncorrelated) {
    const std::vector<double> energy{0.1, 0.4, 0.3, 0.2};
    const auto slabs = field::evenSlabProducts(energy);
    const std::vector<double> weights{1.0, -2.0, 3.0, 0.5};
    EXPECT_NEAR(slabs.energy(weights), 0.1 + 4.0 * 0.4 + 9.0 * 0.3 + 0.25 * 0.2, 1e-12);
    // More samples than slabs: nothing is lost.
    const std::vector<double> many(101, 1.0 / 101.0);
    const auto few = field::evenSlabProducts(many);
    EXPECT_NEAR(few.energy(std::vector<double>(std::size_t(few.slabs), 1.0)), 1.0, 1e-12);
}

} // namespace
} // namespace pellucid
