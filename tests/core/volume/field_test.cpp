// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "core/volume/field.h"
#include "core/volume/lane_sum.h"

namespace pellucid {

namespace {

using volume::Field;
using volume::Ramp;
using volume::Volume;

const auto lattice = volume::Lattice::centred({5, 3, 2}, {1, 1, 1});

std::vector<std::int16_t> integers() {
    std::vector<std::int16_t> samples(lattice.size().count());
    std::iota(samples.begin(), samples.end(), std::int16_t(-4));
    return samples;
}
std::vector<float> floats() {
    const auto from = integers();
    return {from.begin(), from.end()};
}

TEST(Field, FloatsAreReadInPlace) {
    const Volume volume(lattice, floats(), volume::ValueUnit::none);
    const Field field(volume);
    float buffer[5] = {};
    const float *const row = field.row({1, 2, 1}, 4, buffer);
    EXPECT_EQ(row, volume.floats() + lattice.size().offsetOf(1, 2, 1));
    float copy[4] = {};
    field.copyRow({1, 2, 1}, 4, copy);
    for (int n = 0; n < 4; ++n)
        EXPECT_EQ(copy[n], row[n]);
}

TEST(Field, IsTheRampOfItsSamplesWithinItsBox) {
    const Ramp ramp{-2.0F, 0.125F};
    const volume::VoxelBox box{{1, 0, 1}, {4, 2, 2}};
    for (const Volume &volume : {Volume(lattice, integers(), volume::ValueUnit::hounsfield),
                                 Volume(lattice, floats(), volume::ValueUnit::none)})
        for (const bool hasRamp : {false, true})
            for (const bool hasBox : {false, true}) {
                Field field = hasRamp ? Field(volume, ramp) : Field(volume);
                if (hasBox)
                    field = field.within(box);
                const Volume copy = field.asVolume();
                EXPECT_TRUE(copy.isFloat());
                float buffer[5];
                for (int k = 0; k < 2; ++k)
                    for (int j = 0; j < 3; ++j)
                        for (int first = 0; first < 5; ++first) {
                            const int count = 5 - first;
                            const float *const row = field.row({first, j, k}, count, buffer);
                            for (int n = 0; n < count; ++n) {
                                const int i = first + n;
                                const bool isInside = i >= 1 && i < 4 && j < 2 && k == 1;
                                const auto value = float(volume.value({i, j, k}));
                                const float expected = hasBox && !isInside ? 0.0F
                                                       : hasRamp           ? ramp(value)
                                                                           : value;
                                EXPECT_EQ(row[n], expected);
                                EXPECT_EQ(field.value({i, j, k}), double(expected));
                                EXPECT_EQ(copy.value({i, j, k}), double(expected));
                            }
                        }
            }
    // A box within a box.
    const Field twice = Field(Volume(lattice, floats(), volume::ValueUnit::none))
                            .within(box)
                            .within({{0, 1, 0}, {3, 3, 2}});
    EXPECT_NE(twice.value({2, 1, 1}), 0.0);
    EXPECT_EQ(twice.value({3, 1, 1}), 0.0);
    EXPECT_EQ(twice.value({2, 0, 1}), 0.0);
}

TEST(Field, TheRampIsClampedAndNanIsZero) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    const Ramp ramp{1.0F, 0.5F};
    EXPECT_EQ(ramp(2.0F), 0.5F);
    EXPECT_EQ(ramp(0.0F), 0.0F);
    EXPECT_EQ(ramp(4.0F), 1.0F);
    EXPECT_EQ(ramp(inf), 1.0F);
    EXPECT_EQ(ramp(-inf), 0.0F);
    EXPECT_EQ(ramp(std::numeric_limits<float>::quiet_NaN()), 0.0F);
    EXPECT_EQ((Ramp{1.0F, 0.0F}(inf)), 0.0F); // a window without width
}

TEST(LaneSum, AddsEveryTerm) {
    for (const int count : {-1, 0, 1, 7, 8, 9, 100}) {
        const int sum = volume::laneSum(count, [](int n) { return n + 1; });
        EXPECT_EQ(sum, std::max(0, count) * (std::max(0, count) + 1) / 2);
    }
}

} // namespace
} // namespace pellucid
