// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "core/classify/density_field.h"

namespace pellucid {

namespace {

using volume::Volume;

const auto lattice = volume::Lattice::centred({4, 3, 2}, {1, 1, 1});

TEST(DensityField, MapsTheWindowAndClamps) {
    std::vector<std::int16_t> hu(24, -1000);
    hu[0] = -900;
    hu[5] = 550;
    hu[6] = 3000;
    const Volume volume(lattice, hu, volume::ValueUnit::hounsfield);
    const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
    EXPECT_EQ(field.values.value({0, 0, 0}), 0.0);
    EXPECT_NEAR(field.values.value({1, 1, 0}), 0.5, 1e-6);
    EXPECT_EQ(field.values.value({2, 1, 0}), 1.0);
    EXPECT_EQ(field.support, (volume::VoxelBox{{1, 1, 0}, {3, 2, 1}}));
}

TEST(DensityField, NanIsNothingAndInfinityIsClamped) {
    const float inf = std::numeric_limits<float>::infinity();
    std::vector<float> values(24, 0.0F);
    values[1] = std::numeric_limits<float>::quiet_NaN();
    values[2] = inf;
    values[3] = -inf;
    const auto field =
        classify::densityField(Volume(lattice, values, volume::ValueUnit::none), {0.0, 1.0});
    EXPECT_EQ(field.values.value({1, 0, 0}), 0.0);
    EXPECT_EQ(field.values.value({2, 0, 0}), 1.0);
    EXPECT_EQ(field.values.value({3, 0, 0}), 0.0);
}

TEST(DensityField, WithoutUnitTheWindowIsTheQuantiles) {
    std::vector<float> values(24);
    for (int n = 0; n < 24; ++n)
        values[n] = float(n);
    const auto window =
        classify::defaultFieldWindow(Volume(lattice, values, volume::ValueUnit::none));
    EXPECT_NEAR(window.low, 0.005 * 23, 1e-6);
    EXPECT_NEAR(window.high, 0.995 * 23, 1e-6);
}

TEST(DensityField, NothingAboveTheWindowLeavesOneEmptySample) {
    const Volume air(lattice, std::vector<std::int16_t>(24, -1000), volume::ValueUnit::hounsfield);
    const auto field = classify::densityField(air, {-900, 2000});
    EXPECT_EQ(field.support.size().count(), 1U);
    // Constant: a window without width.
    EXPECT_EQ(classify::densityField(air, {-1000, -1000}).support.size().count(), 1U);
}

TEST(DensityField, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    const Volume air(lattice, std::vector<std::int16_t>(24, 0), volume::ValueUnit::hounsfield);
    EXPECT_THROW(classify::densityField(air, {0, 1}, task::Progress(source.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
