// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/picture/compose.h"

namespace pellucid {

namespace {

TEST(Compose, MapsTheRangeAndInverts) {
    const picture::ProjectionImage image{4, 1, 1.0, {-1.0F, 0.0F, 5.0F, 20.0F}};
    const auto bright = picture::compose(image, {0.0, 10.0, false});
    const auto film = picture::compose(image, {0.0, 10.0, true});
    EXPECT_EQ(bright[0], 0);
    EXPECT_EQ(bright[12], 255);
    EXPECT_EQ(bright[8], 128);
    for (int n = 0; n < 4; ++n)
        EXPECT_NEAR(int(bright[4 * n]) + film[4 * n], 255, 1);
    EXPECT_EQ(bright[3], 255);
}

// Each pixel equals the definition, or is the next level at a tie. The number of pixels is not a
// multiple of a vector.
TEST(Compose, EveryPixelIsOnTheCurve) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> values(-3.0F, 13.0F);
    for (const int channels : {1, 3})
        for (const auto &[inverted, isFaded] :
             {std::pair(false, false), {true, false}, {false, true}, {true, true}}) {
            picture::ProjectionImage image{20011, 1, 1.0, {}, channels};
            for (int n = 0; n < image.width * channels; ++n)
                image.samples.push_back(values(random));
            image.samples[0] = 0.0F;
            const double low = 0.5, high = 10.0;
            const double exponent = 1.0 / 1.4, air = 2.0;
            const auto shown = picture::compose(
                image, {{low, high}, inverted, exponent, {}, 0.5, isFaded ? air : 0.0});
            int ties = 0;
            for (std::size_t n = 0; n < std::size_t(image.width); ++n) {
                const float *const pixel = image.samples.data() + n * std::size_t(channels);
                const double most = *std::max_element(pixel, pixel + channels);
                const double share = isFaded ? std::clamp((most - 0.5) / air, 0.0, 1.0) : 1.0;
                const double curved =
                    std::pow(std::clamp((most - low) / (high - low), 0.0, 1.0), exponent) * share *
                    share * (3.0 - 2.0 * share);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double value = channels == 1 ? most : double(pixel[c]);
                    const double x = most > 0.0 ? curved * std::max(0.0, value) / most : curved;
                    const double level = 255.0 * (inverted ? 1.0 - x : x);
                    ASSERT_NEAR(shown[4 * n + c], level, 0.5 + 1e-4) << n;
                    ties += shown[4 * n + c] != std::lround(level) ? 1 : 0;
                }
                ASSERT_EQ(shown[4 * n + 3], 255);
            }
            EXPECT_LT(ties, 20);
        }
}

// Bright colors keep the ratio of their channels, up to and beyond the range.
TEST(Compose, ColorsKeepTheirHue) {
    const picture::ProjectionImage image{
        4,
        1,
        1.0,
        {10.0F, 5.0F, 0.0F, 40.0F, 20.0F, 0.0F, 2.0F, 2.0F, 2.0F, -1.0F, -2.0F, -3.0F},
        3};
    const auto bright = picture::compose(image, {0.0, 10.0, false});
    EXPECT_EQ(bright[0], 255);
    EXPECT_NEAR(bright[1], 127.5, 0.5);
    EXPECT_EQ(bright[2], 0);
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(bright[4 + c], bright[c]); // four times as bright: the same color
    EXPECT_EQ(bright[8], bright[10]);        // grey stays grey, on the curve of grey images
    EXPECT_EQ(bright[8], 51);
    EXPECT_EQ(bright[12] + bright[13] + bright[14], 0);
    const auto film = picture::compose(image, {0.0, 10.0, true});
    for (int n = 0; n < 16; ++n)
        EXPECT_NEAR(int(bright[n]) + film[n], n % 4 == 3 ? 510 : 255, 1);
    // A range that begins below zero brightens the noise of empty parts, but does not color it.
    const auto lifted = picture::compose({1, 1, 1.0, {0.1F, 0.0F, -0.1F}, 3}, {-60.0, 10.0, false});
    EXPECT_GT(lifted[0], 200);
    EXPECT_LE(lifted[0] - lifted[2], 1);
    // Values below zero are grey too, and higher values are brighter.
    const auto below = picture::compose({2, 1, 1.0, {-9.5F, -9.7F, -9.9F, -1.0F, -3.0F, -5.0F}, 3},
                                        {-10.0, 90.0, false});
    for (int n = 0; n < 8; n += 4)
        EXPECT_TRUE(below[n] == below[n + 1] && below[n] == below[n + 2]);
    EXPECT_LT(below[0], below[4]);
}

TEST(Compose, TheOrderOfThePixelsBytesIsChosen) {
    for (const int channels : {1, 3})
        for (const int width : {1, 16, 37}) { // whole vectors and parts of one
            picture::ProjectionImage image{width, 1, 1.0, {}, channels};
            for (int n = 0; n < width * channels; ++n)
                image.samples.push_back(float(n * n % 11));
            const auto rgba = picture::compose(image, {0.0, 10.0, false}),
                       bgra =
                           picture::compose(image, {0.0, 10.0, false}, picture::PixelOrder::bgra);
            for (int n = 0; n < 4 * width; n += 4) {
                EXPECT_EQ(rgba[n], bgra[n + 2]);
                EXPECT_EQ(rgba[n + 1], bgra[n + 1]);
                EXPECT_EQ(rgba[n + 2], bgra[n]);
                EXPECT_EQ(bgra[n + 3], 255);
            }
        }
}

} // namespace
} // namespace pellucid
