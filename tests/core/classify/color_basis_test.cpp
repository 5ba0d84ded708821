// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "core/classify/color_basis.h"

namespace pellucid {

namespace {

using classify::ColorBasis;
using Rgb = ColorBasis::Rgb;

// Every color is its amounts of the basis, and none is negative.
void expectMixes(const ColorBasis &basis, const std::vector<Rgb> &colors) {
    ASSERT_EQ(basis.amounts.size(), colors.size());
    for (std::size_t n = 0; n < colors.size(); ++n)
        for (std::size_t c = 0; c < 3; ++c) {
            double mixed = 0.0;
            for (std::size_t b = 0; b < basis.colors.size(); ++b) {
                EXPECT_GE(basis.amounts[n][b], -1e-12);
                mixed += basis.amounts[n][b] * basis.colors[b][c];
            }
            EXPECT_NEAR(mixed, colors[n][c], 2e-7) << n << " " << c;
        }
}

TEST(ColorBasis, OfOneHueIsTheBrightest) {
    const std::vector<Rgb> colors{{0.4, 0.2, 0.0}, {0.0, 0.0, 0.0}, {0.8, 0.4, 0.0}};
    const ColorBasis basis = classify::colorBasis(colors);
    ASSERT_EQ(basis.colors, std::vector<Rgb>{colors[2]});
    EXPECT_EQ(basis.amounts[2][0], 1.0);
    expectMixes(basis, colors);
}

TEST(ColorBasis, OfTwoColorsIsThemselves) {
    const std::vector<Rgb> colors{{1.0, 0.2, 0.0}, {0.9, 0.9, 0.9}};
    const ColorBasis basis = classify::colorBasis(colors);
    EXPECT_EQ(basis.colors, colors);
    EXPECT_EQ(basis.amounts[0], (Rgb{1.0, 0.0, 0.0}));
    EXPECT_EQ(basis.amounts[1], (Rgb{0.0, 1.0, 0.0}));
}

TEST(ColorBasis, OfColorsInAPlaneIsTheOutermostTwo) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> even;
    for (int trial = 0; trial < 200; ++trial) {
        const Rgb a{even(random), even(random), even(random)},
            b{even(random), even(random), even(random)};
        std::vector<Rgb> colors;
        for (int n = 0; n < 6; ++n) {
            const double s = even(random), t = even(random);
            colors.push_back({s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]});
        }
        const ColorBasis basis = classify::colorBasis(colors);
        ASSERT_EQ(basis.colors.size(), 2U) << trial;
        expectMixes(basis, colors);
        colors.push_back({a[0] + b[0], a[1] + b[1], a[2] + b[2] + 0.01});
        const ColorBasis three = classify::colorBasis(colors);
        EXPECT_EQ(three.colors.size(), 3U) << trial;
        EXPECT_EQ(three.amounts, colors);
    }
}

// The closest that colors of 8 bits come to a line or plane without being in it.
TEST(ColorBasis, TellsColorsOfEightBitsApart) {
    const auto of = [](int red, int green, int blue) {
        return Rgb{red / 255.0, green / 255.0, blue / 255.0};
    };
    EXPECT_EQ(classify::colorBasis(std::vector{of(255, 254, 0), of(254, 253, 0)}).colors.size(),
              2U);
    EXPECT_EQ(classify::colorBasis(std::vector{of(255, 254, 0), of(254, 253, 0), of(255, 255, 1)})
                  .colors.size(),
              3U);
}

} // namespace
} // namespace pellucid
