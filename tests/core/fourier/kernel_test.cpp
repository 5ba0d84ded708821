// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/fourier/kernel.h"

namespace pellucid {

namespace {

using fourier::Kernel;

class ExponentialSemicircle : public testing::TestWithParam<int> {};

TEST_P(ExponentialSemicircle, PolynomialsFollowTheFormula) {
    const int w = GetParam();
    const Kernel kernel = Kernel::exponentialSemicircle(w, 1.5);
    const double b = 0.976 * std::numbers::pi * w * (1.0 - 1.0 / 3.0);
    // The kernel's own accuracy is about 10^-(w-1); its edge falls to exp(-b) with infinite slope,
    // which no polynomial follows: a tenth of the accuracy plus half the edge.
    const double allowed = 0.1 * std::pow(10.0, 1 - w) + 0.5 * std::exp(-b);
    for (double t = -0.5 * w + 1e-6; t < 0.5 * w; t += 0.0137) {
        const double x = 2.0 * t / w;
        EXPECT_NEAR(kernel.value(t), std::exp(b * (std::sqrt(1.0 - x * x) - 1.0)), allowed) << t;
    }
    EXPECT_EQ(kernel.value(0.5 * w + 0.001), 0.0);
}

TEST_P(ExponentialSemicircle, IsEven) {
    const Kernel kernel = Kernel::exponentialSemicircle(GetParam(), 1.5);
    for (double t = 0.01; t < 0.5 * GetParam(); t += 0.091)
        EXPECT_NEAR(kernel.value(t), kernel.value(-t), 1e-12);
}

TEST_P(ExponentialSemicircle, WeightsAreTheKernelAtTheTaps) {
    const int w = GetParam();
    const Kernel kernel = Kernel::exponentialSemicircle(w, 1.5);
    std::array<float, 8> weights{};
    for (float c = -0.499F; c < 0.5F; c += 0.0831F) {
        kernel.weights(c, weights.data());
        for (int k = 0; k < w; ++k)
            EXPECT_NEAR(weights[k], kernel.value(c + k - 0.5 * (w - 1)), 3e-7)
                << k; // a few float roundings
    }
}

TEST_P(ExponentialSemicircle, ApodisationIsTheKernelsTransform) {
    const int w = GetParam(), padded = 48;
    const Kernel kernel = Kernel::exponentialSemicircle(w, 1.5);
    for (const double x : {0.0, 3.0, -11.0, 16.0}) {
        double sum = 0.0; // midpoint rule, 4e-9 fine
        const int steps = 200000;
        for (int n = 0; n < steps; ++n) {
            const double t = w * ((n + 0.5) / steps - 0.5);
            sum += kernel.value(t) * std::cos(2.0 * std::numbers::pi * t * x / padded);
        }
        EXPECT_NEAR(kernel.apodisation(x, padded), sum * w / steps, 1e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(Widths, ExponentialSemicircle, testing::Values(4, 5, 6));

} // namespace
} // namespace pellucid
