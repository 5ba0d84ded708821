// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/coverages.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace pellucid {
namespace {

using volume::Coverage;
using volume::GridSize;
using volume::Lattice;

Coverage boxOf(const volume::VoxelBox &box) {
    return {box, std::vector<std::uint8_t>(box.size().count(), 255)};
}

double sumOf(const Coverage &coverage) {
    double sum = 0.0;
    for (const std::uint8_t share : coverage.shares)
        sum += share / 255.0;
    return sum;
}

TEST(Coverages, SoftEdgesKeepVolumeAndHaveTheirWidth) {
    const GridSize size{80, 40, 40};
    const Coverage region = boxOf({{20, 12, 14}, {60, 30, 28}});
    for (const double sigma : {0.3, 0.5, 0.7, 1.0, 2.5}) {
        const Coverage soft = segment::softened(region, size, sigma);
        EXPECT_NEAR(sumOf(soft) / sumOf(region), 1.0, 2e-3) << sigma;
        // The derivative along the first axis has the variance of the filter.
        double weight = 0.0, variance = 0.0;
        for (int i = 1; i < 40; ++i) {
            const double step = (soft.at({i, 21, 21}) - soft.at({i - 1, 21, 21})) / 255.0;
            weight += step;
            variance += step * (i - 20.0) * (i - 20.0);
        }
        // The other edges take a part of the middle, too.
        EXPECT_NEAR(weight, 1.0, 0.01) << sigma;
        EXPECT_NEAR(std::sqrt(variance / weight), sigma, 0.03 + 0.02 * sigma) << sigma;
    }
    EXPECT_EQ(segment::softened(region, size, 0.0), region);
}

TEST(Coverages, ABorderOfTheVolumeIsNoEdge) {
    const GridSize size{20, 20, 20};
    const Coverage soft = segment::softened(boxOf({{0, 5, 5}, {10, 15, 15}}), size, 0.7);
    EXPECT_EQ(int(soft.at({0, 10, 10})), 255);
    EXPECT_LT(int(soft.at({9, 10, 10})), 255);
    EXPECT_GE(soft.box.lo.i, 0);
}

// The band-limited interpolation of a hard edge swings 9 % beyond it (Gibbs), of a soft one less.
TEST(Coverages, SoftEdgesRingLess) {
    constexpr int n = 64, finer = 16;
    const auto overshoot = [&](double sigma) {
        const Coverage soft = segment::softened(boxOf({{16, 0, 0}, {48, 1, 1}}), {n, 1, 1}, sigma);
        double most = 0.0;
        for (int at = 0; at < n * finer; ++at) {
            // Interpolates the samples by their discrete Fourier series.
            double value = 0.0;
            for (int i = 0; i < n; ++i) {
                const double d = std::numbers::pi * (double(at) / finer - i);
                const double kernel =
                    std::abs(std::sin(d / n)) < 1e-12 ? 1.0 : std::sin(d) / (n * std::tan(d / n));
                value += soft.at({i, 0, 0}) / 255.0 * kernel;
            }
            most = std::max(most, value - 1.0);
        }
        return most;
    };
    EXPECT_GT(overshoot(0.0), 0.085);
    EXPECT_LT(overshoot(0.5), 0.045);
    EXPECT_LT(overshoot(0.7), 0.012);
}

TEST(Coverages, CoarserLatticesGetTheMeans) {
    const Lattice fine = Lattice::centred({30, 24, 18}, {1.0, 1.5, 2.0});
    const Lattice coarse =
        Lattice::make({10, 8, 6}, fine.patient(volume::VoxelPoint{{1.0, 1.0, 1.0}}),
                      {3.0 * fine.step(0), 3.0 * fine.step(1), 3.0 * fine.step(2)});
    std::mt19937 random(2);
    Coverage region = boxOf({{4, 5, 6}, {22, 19, 16}});
    for (std::uint8_t &share : region.shares)
        share = std::uint8_t(random());
    const Coverage means = segment::coarsened(region, fine, coarse);
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 10; ++i) {
                double sum = 0.0;
                for (int w = 0; w < 3; ++w)
                    for (int v = 0; v < 3; ++v)
                        for (int u = 0; u < 3; ++u)
                            sum += region.at({3 * i + u, 3 * j + v, 3 * k + w});
                ASSERT_EQ(means.at({i, j, k}), std::lround(sum / 27.0));
            }
}

} // namespace
} // namespace pellucid
