// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/scene/image_definition.h"

namespace pellucid {

namespace {

using scene::ImageDefinition;
using scene::Reconstruction;

TEST(ImageDefinition, RollOffIsOneThenFallsToZero) {
    EXPECT_EQ(scene::rollOffFactor(0.05, 0.9), 1.0);
    EXPECT_NEAR(scene::rollOffFactor(0.05, 0.975), 0.5, 1e-12);
    EXPECT_EQ(scene::rollOffFactor(0.05, 1.0), 0.0);
    EXPECT_EQ(scene::rollOffFactor(0.0, 0.9999), 1.0); // F = 0: a sharp edge
}

// A reconstruction keeps constants: K(0) = 1 and K(q) = 0 at every other integer q.
TEST(ImageDefinition, ReconstructionsKeepConstants) {
    for (const auto r : {Reconstruction::cubic, Reconstruction::linear, Reconstruction::bandLimited,
                         Reconstruction::spline}) {
        EXPECT_NEAR(scene::reconstructionFactor({r, 0.05}, 0.0), 1.0, 1e-12);
        for (const double q : {1.0, -2.0, 3.0})
            EXPECT_NEAR(scene::reconstructionFactor({r, 0.05}, q), 0.0, 1e-12);
    }
}

TEST(ImageDefinition, LinearIsTheTransformOfTheTent) {
    for (const double q : {0.1, 0.37, 0.8, 1.6}) {
        double tent = 0.0;
        const int steps = 20000;
        for (int n = 0; n < steps; ++n) {
            const double x = 2.0 * (n + 0.5) / steps - 1.0;
            tent += (1.0 - std::abs(x)) * std::cos(2.0 * std::numbers::pi * q * x) * 2.0 / steps;
        }
        EXPECT_NEAR(scene::reconstructionFactor({Reconstruction::linear, 0.05}, q), tent, 1e-7);
    }
}

// Keys 1981, eq. 15 with a = -1/2, is piecewise cubic. The error of Simpson's rule on each piece is
// of the fourth power of its step: 1e-12 here.
TEST(ImageDefinition, CubicIsTheTransformOfKeysConvolution) {
    const auto keys = [](double x) {
        return x < 1.0 ? (1.5 * x - 2.5) * x * x + 1.0 : ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0;
    };
    for (const double q : {0.0, 1e-6, 1e-3, 0.02, 0.1, 0.37, 0.5, 0.8, 1.0, 1.6, 2.5}) {
        double sum = 0.0;
        constexpr int steps = 4000;
        for (const double piece : {0.0, 1.0})
            for (int n = 0; n <= steps; ++n) {
                const double x = piece + double(n) / steps;
                const double weight = n == 0 || n == steps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
                sum += 2.0 * weight / (3.0 * steps) * keys(x) *
                       std::cos(2.0 * std::numbers::pi * q * x);
            }
        EXPECT_NEAR(scene::reconstructionFactor({Reconstruction::cubic, 0.05}, q), sum, 1e-11) << q;
        EXPECT_EQ(scene::reconstructionFactor({Reconstruction::cubic, 0.05}, -q),
                  scene::reconstructionFactor({Reconstruction::cubic, 0.05}, q));
    }
}

// A reconstruction interpolates if the sum of K over all periods is 1: samples keep their values.
TEST(ImageDefinition, CubicAndLinearInterpolate) {
    for (const auto r : {Reconstruction::cubic, Reconstruction::linear, Reconstruction::spline})
        for (const double q : {0.05, 0.3, 0.5}) {
            double sum = 0.0;
            for (int period = -4000; period <= 4000; ++period)
                sum += scene::reconstructionFactor({r, 0.05}, q + period);
            // The tail of sinc^2 beyond 4000 periods is 1/(pi^2 4000).
            EXPECT_NEAR(sum, 1.0, 6e-5);
        }
}

// The image plus A times its difference from a smoothed one.
TEST(ImageDefinition, DetailRisesFromLargeToFineStructures) {
    const ImageDefinition plain;
    EXPECT_EQ(scene::detailFactor(plain, 0.3), 1.0);
    EXPECT_EQ(scene::detailGain(plain), 1.0);
    const ImageDefinition sharp{.detail = 1.5, .detailMm = 3.0};
    EXPECT_EQ(scene::detailFactor(sharp, 0.0), 1.0);
    EXPECT_NEAR(scene::detailFactor(sharp, 1.0 / (2.0 * 3.14159265358979323846 * 3.0)), 1.75,
                1e-12);
    EXPECT_NEAR(scene::detailFactor(sharp, 1e4), 2.5, 1e-6);
    EXPECT_EQ(scene::detailGain(sharp), 2.5);
    for (double perMm = 0.0; perMm < 2.0; perMm += 0.01) {
        EXPECT_LE(scene::detailFactor(sharp, perMm), scene::detailFactor(sharp, perMm + 0.01));
        EXPECT_GE(scene::detailFactor(sharp, perMm), 1.0);
    }
}

} // namespace
} // namespace pellucid
