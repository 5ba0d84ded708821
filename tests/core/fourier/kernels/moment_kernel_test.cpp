// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels/moment_kernel.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace pellucid {

namespace {

using fourier::Kernel;
using fourier::MomentKernel;

class Moment : public testing::TestWithParam<std::string> {};

TEST_P(Moment, IsOddAndItsPairsAreItsValues) {
    const Kernel kernel = makeKernel(fourier::kernelFromName(GetParam()), 1.5);
    const MomentKernel moment(kernel, 1.5);
    const int width = moment.width(), terms = moment.terms();
    ASSERT_EQ(width, kernel.width());
    for (const double c : {-0.45, -0.1, 0.2, 0.4})
        for (int k = 0; k < (width + 1) / 2; ++k) {
            const float *const pair = moment.pairs().data() + std::ptrdiff_t(2) * terms * k;
            double even = 0.0, odd = 0.0;
            for (int n = terms - 1; n >= 0; --n) {
                even = even * c * c + double(pair[n]);
                odd = odd * c * c + double(pair[terms + n]);
            }
            const double t = c + k - 0.5 * (width - 1);
            // Pairs are floats of values up to 1.
            EXPECT_NEAR(even + c * odd, moment.value(t), 3e-7);
            EXPECT_NEAR(moment.value(-t), -moment.value(t), 1e-12);
            if (2 * k != width - 1) {
                EXPECT_NEAR(c * odd - even, moment.value(c - k + 0.5 * (width - 1)), 3e-7);
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Kernels, Moment,
                         testing::Values("nearest", "trilinear", "b-spline", "hamming-sinc", "ES4",
                                         "KB5", "LS2", "LS3", "LS4", "LS5", "LS6", "LS7"),
                         [](const auto &test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

// A moment kernel gives x h(x) within the field and little beyond: about as much as the exact
// derivative of the kernel, (x + m) h(x + m), and at most 1.4 times that.
TEST(Moments, LeaveWhatADerivativeLeaves) {
    for (const int width : {3, 4, 5, 6, 7})
        for (const double padding : {1.25, 1.5, 2.0}) {
            const Kernel kernel = Kernel::leastAliasing(width, padding);
            const MomentKernel moment(kernel, padding);
            double left = 0.0, derivative = 0.0;
            constexpr int positions = 50;
            for (int n = 0; n < positions; ++n) {
                const double x = (n + 0.5) / positions / (2.0 * padding);
                const double h = kernel.apodisation(x);
                for (int m = -3; m <= 3; ++m) {
                    left += std::pow(moment.response(x + m) / h - (m == 0 ? x : 0.0), 2);
                    derivative +=
                        m == 0 ? 0.0 : std::pow((x + m) * kernel.apodisation(x + m) / h, 2);
                }
            }
            EXPECT_LT(std::sqrt(left), 1.4 * std::sqrt(derivative)) << width << " " << padding;
        }
}

// The derivative fails for kernels that jump at their edge: it leaves out a delta there.
TEST(Moments, StandKernelsThatJump) {
    const Kernel kernel = Kernel::exponentialSemicircle(4, 1.5);
    const MomentKernel moment(kernel, 1.5);
    double worst = 0.0;
    for (int n = 0; n < 30; ++n) {
        const double x = (n + 0.5) / 30 / 3.0;
        worst = std::max(worst, std::abs(moment.response(x) / kernel.apodisation(x) - x));
    }
    EXPECT_LT(worst, 2e-3); // of a third, the farthest there is
}

} // namespace
} // namespace pellucid
