// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "core/classify/shown_fields.h"
#include "core/task/error.h"

namespace pellucid {

namespace {

using classify::Color;
using classify::TissueClass;

// Values from -1000 to 1900 HU along the columns.
volume::Volume ramp() {
    std::vector<float> samples;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 30; ++i)
            samples.push_back(-1000.0F + 100.0F * float(i));
    return {volume::Lattice::centred({30, 2, 1}, {1, 1, 1}), samples,
            volume::ValueUnit::hounsfield};
}

constexpr classify::FieldWindow window{-1000.0, 2000.0};

TEST(TissueClass, MembershipRisesAndFallsAboutTheEnds) {
    const TissueClass tissue{"t", 100.0, 500.0, 40.0};
    EXPECT_EQ(tissue.membership(79.0), 0.0);
    EXPECT_NEAR(tissue.membership(100.0), 0.5, 1e-12);
    EXPECT_NEAR(tissue.membership(110.0), 0.5 + 0.5 * std::sin(0.25 * 3.14159265358979), 1e-9);
    EXPECT_EQ(tissue.membership(300.0), 1.0);
    EXPECT_NEAR(tissue.membership(500.0), 0.5, 1e-12);
    EXPECT_EQ(tissue.membership(521.0), 0.0);
    const TissueClass hard{"h", 100.0, 500.0};
    EXPECT_EQ(hard.membership(100.0), 1.0);
    EXPECT_EQ(hard.membership(99.9), 0.0);
}

TEST(TissueClass, ClassFieldsAreDensityTimesMembership) {
    const TissueClass tissue{"t", 0.0, 600.0, 400.0};
    const auto field = classify::classField(ramp(), window, tissue, nullptr);
    for (int i = 0; i < 30; ++i) {
        const double value = -1000.0 + 100.0 * i;
        EXPECT_NEAR(field.values.value({i, 1, 0}),
                    (value + 1000.0) / 3000.0 * tissue.membership(value), 1e-6);
    }
    EXPECT_EQ(field.support.lo.i, 9); // -100 HU is the first within -200 and 800 that is not 0
    EXPECT_EQ(field.support.hi.i, 18);
}

TEST(TissueClass, NansBelongToNoClass) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const volume::Volume values(volume::Lattice::centred({4, 1, 1}, {1, 1, 1}),
                                std::vector<float>{nan, infinity, -infinity, 50.0F},
                                volume::ValueUnit::none);
    const auto field = classify::classField(values, {0.0, 100.0}, {"t", 0.0, 60.0, 10.0}, nullptr);
    EXPECT_EQ(field.values.value({0, 0, 0}), 0.0);
    EXPECT_EQ(field.values.value({1, 0, 0}), 0.0);
    EXPECT_EQ(field.values.value({2, 0, 0}), 0.0);
    EXPECT_NEAR(field.values.value({3, 0, 0}), 0.5, 1e-6);
}

TEST(ShownFields, AWindowWithoutWidthShowsNothingWhateverTheValue) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const volume::Volume values(volume::Lattice::centred({3, 1, 1}, {1, 1, 1}),
                                std::vector<float>{7.0F, infinity, -infinity},
                                volume::ValueUnit::none);
    const auto bent = classify::shownFields(
        values, {7.0, 7.0}, {classify::TransferFunction{{0.5, 2.0, 1.0}}, {}}, nullptr);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(bent.channels[0].values.value({i, 0, 0}), 0.0);
}

TEST(ShownFields, AreAsManyAsTheColorsHaveRank) {
    const TissueClass low{"low", -500, 0, 100, 0.5, Color{1.0, 0.5, 0.0}};
    const TissueClass high{"high", 200, 900, 100, 2.0, Color{0.0, 0.5, 1.0}};
    TissueClass alike = high;
    alike.color = low.color;
    const volume::Volume volume = ramp();
    const auto one = classify::shownFields(volume, window, {{}, {low, alike}}, nullptr);
    ASSERT_EQ(one.channels.size(), 1U);
    EXPECT_EQ(one.colors.front(), low.color);
    EXPECT_FALSE(one.isGrey());
    EXPECT_FALSE(classify::isGrey({{}, {low, alike}}));
    EXPECT_FALSE(classify::isGrey({{}, {low, high}}));
    TissueClass white = low;
    white.color = {};
    EXPECT_TRUE(classify::isGrey({{}, {white}}));
    EXPECT_TRUE(classify::isGrey({}));
    const auto mixed = classify::shownFields(volume, window, {{}, {low, high}}, nullptr);
    ASSERT_EQ(mixed.channels.size(), 2U);
    EXPECT_EQ(mixed.colors[0], low.color);
    EXPECT_EQ(mixed.colors[1], high.color);
    const auto primary = classify::inPrimaries(mixed);
    ASSERT_EQ(primary.channels.size(), 3U);
    TissueClass third{"third", -100, 400, 100, 1.0, Color{0.5, 0.5, 0.5}};
    // The third color is half of each of the others, hence in a plane with them.
    EXPECT_EQ(classify::channelsOf({{}, {low, high, third}}), 2U);
    third.color.green = 0.6;
    const auto three = classify::shownFields(volume, window, {{}, {low, high, third}}, nullptr);
    ASSERT_EQ(three.channels.size(), 3U);
    EXPECT_EQ(three.colors, classify::primaries);
    const auto a = classify::classField(volume, window, low, nullptr);
    const auto b = classify::classField(volume, window, high, nullptr);
    for (int i = 0; i < 30; ++i) {
        const volume::VoxelIndex at{i, 0, 0};
        const double la = 0.5 * a.values.value(at), lb = 2.0 * b.values.value(at);
        EXPECT_NEAR(one.channels[0].values.value(at), la + lb, 1e-6);
        EXPECT_NEAR(mixed.channels[0].values.value(at), la, 1e-6);
        EXPECT_NEAR(mixed.channels[1].values.value(at), lb, 1e-6);
        EXPECT_NEAR(primary.channels[0].values.value(at), la, 1e-6);
        EXPECT_NEAR(primary.channels[1].values.value(at), 0.5 * (la + lb), 1e-6);
        EXPECT_NEAR(primary.channels[2].values.value(at), lb, 1e-6);
    }
}

TEST(ShownFields, WithoutClassesTheTransferFunctionShowsTheDensity) {
    const volume::Volume volume = ramp();
    const auto plain = classify::shownFields(volume, window, {}, nullptr);
    EXPECT_TRUE(plain.isGrey());
    const classify::TransferFunction function{{0.0, 2.0, 1.0}};
    const auto bent = classify::shownFields(volume, window, {function, {}}, nullptr);
    for (int i = 0; i < 30; ++i) {
        const double f = plain.channels[0].values.value({i, 0, 0});
        EXPECT_NEAR(bent.channels[0].values.value({i, 0, 0}), f * function.at(f), 1e-6);
    }
}

TEST(ShownFields, ClassesWithoutWeightShowNothing) {
    const auto none =
        classify::shownFields(ramp(), window, {{}, {{"t", 0.0, 600.0, 0.0, 0.0}}}, nullptr);
    ASSERT_EQ(none.channels.size(), 1U);
    EXPECT_EQ(none.channels[0].support.size().count(), 1U);
}

TEST(ShownFields, BadClassesAreRefusedByName) {
    for (const TissueClass &bad :
         {TissueClass{"", 0, 1}, TissueClass{"t", 2, 1}, TissueClass{"t", 0, 1, -1},
          TissueClass{"t", 0, 1, 0, 2.5}, TissueClass{"t", 0, 1, 0, 1, Color{1.0, -0.1, 0.0}},
          TissueClass{"t", 0, 1, 0, 1, Color{}, classify::TransferFunction{{3.0, 0.0}}}})
        EXPECT_THROW(classify::validate(classify::Look{{}, {bad}}), task::Error);
    EXPECT_THROW(classify::colorFromText("#12345g"), task::Error);
    EXPECT_EQ(classify::colorText(classify::colorFromText("#0a80ff")), "#0a80ff");
}

} // namespace
} // namespace pellucid
