// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/volume/statistics.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using volume::Volume;

Volume line(std::vector<float> samples) {
    const auto lattice = volume::Lattice::centred({int(samples.size()), 1, 1}, {1, 1, 1});
    return {lattice, std::move(samples), volume::ValueUnit::none};
}

double sortedQuantile(std::vector<float> sorted, double fraction) {
    std::sort(sorted.begin(), sorted.end());
    const double rank = fraction * double(sorted.size() - 1);
    const auto below = std::size_t(rank);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (rank - double(below)) * (double(sorted[above]) - sorted[below]);
}

TEST(Statistics, QuantilesEqualThoseOfTheSortedSamples) {
    std::mt19937 random(2);
    std::normal_distribution<float> normal(-3.0F, 1e4F);
    std::vector<float> samples(5001);
    for (float &v : samples)
        v = normal(random);
    const std::vector<double> fractions{0.0, 0.005, 0.3333, 0.5, 0.995, 1.0};
    const auto found = volume::quantiles(line(samples), fractions);
    for (std::size_t n = 0; n < fractions.size(); ++n)
        EXPECT_DOUBLE_EQ(found[n], sortedQuantile(samples, fractions[n])) << fractions[n];
}

TEST(Statistics, QuantilesOfIntegersAreExact) {
    std::vector<std::int16_t> samples(1001);
    std::iota(samples.begin(), samples.end(), std::int16_t(-500));
    const Volume volume(volume::Lattice::centred({1001, 1, 1}, {1, 1, 1}), samples,
                        volume::ValueUnit::hounsfield);
    const auto q = volume::quantiles(volume, {0.0, 0.25, 1.0});
    EXPECT_EQ(q[0], -500);
    EXPECT_EQ(q[1], -250);
    EXPECT_EQ(q[2], 500);
}

TEST(Statistics, IgnoresWhatIsNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    const auto volume = line({nan, 1.0F, inf, 3.0F, -inf});
    const auto s = volume::statistics(volume);
    EXPECT_EQ(s.finiteCount, 2U);
    EXPECT_EQ(s.minimum, 1.0);
    EXPECT_EQ(s.maximum, 3.0);
    EXPECT_DOUBLE_EQ(s.mean, 2.0);
    EXPECT_DOUBLE_EQ(s.standardDeviation, 1.0);
    EXPECT_DOUBLE_EQ(volume::quantiles(volume, {0.5})[0], 2.0);
}

TEST(Statistics, NothingFiniteIsZero) {
    const auto volume = line({std::numeric_limits<float>::quiet_NaN()});
    EXPECT_EQ(volume::statistics(volume).finiteCount, 0U);
    EXPECT_EQ(volume::quantiles(volume, {0.5})[0], 0.0);
}

TEST(Statistics, TheHistogramCountsEverySample) {
    const auto h = volume::histogram(line({0, 1, 2, 3, 4, 5, 6, 7, 8, 10}), 10);
    EXPECT_EQ(h.low, 0.0);
    EXPECT_EQ(h.high, 10.0);
    EXPECT_EQ(h.counts, (std::vector<std::uint64_t>{1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
}

} // namespace
} // namespace pellucid
