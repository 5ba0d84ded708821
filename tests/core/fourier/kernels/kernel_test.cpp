// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/fourier/kernels/kernel.h"
#include "core/task/error.h"

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

INSTANTIATE_TEST_SUITE_P(Widths, ExponentialSemicircle, testing::Values(4, 5, 6));

std::vector<Kernel> everyKernel() {
    std::vector<Kernel> all{Kernel::nearest(), Kernel::trilinear(), Kernel::catmullRom(),
                            Kernel::cubicBSpline(), Kernel::hammingSinc()};
    for (int w = 2; w <= 7; ++w) {
        all.push_back(Kernel::exponentialSemicircle(w, 1.5));
        all.push_back(Kernel::kaiserBessel(w, 1.5));
        all.push_back(Kernel::leastAliasing(w, 1.5));
    }
    return all;
}

TEST(Kernels, PairsGiveTheKernelAtTheTaps) {
    for (const Kernel &kernel : everyKernel()) {
        const int w = kernel.width(), terms = kernel.terms();
        for (double c = -0.499; c < 0.5; c += 0.0831)
            for (int k = 0; k < (w + 1) / 2; ++k) {
                const float *pair = kernel.pairs().data() + std::size_t(k) * 2 * terms;
                double even = 0.0, odd = 0.0;
                for (int n = terms - 1; n >= 0; --n) {
                    even = even * c * c + pair[n];
                    odd = odd * c * c + pair[terms + n];
                }
                // Coefficients are rounded to float: a few units in the last place.
                const double t = c + k - 0.5 * (w - 1);
                EXPECT_NEAR(even + c * odd, kernel.value(t), 1e-6) << kernel.name() << " " << t;
                const double mirrored = c + (w - 1 - k) - 0.5 * (w - 1);
                EXPECT_NEAR(even - c * odd, kernel.value(mirrored), 1e-6)
                    << kernel.name() << " " << mirrored;
            }
    }
}

TEST(Kernels, AreEven) {
    for (const Kernel &kernel : everyKernel())
        for (double t = 0.013; t < 0.5 * kernel.width(); t += 0.0917)
            EXPECT_NEAR(kernel.value(t), kernel.value(-t), 1e-12) << kernel.name() << " " << t;
}

TEST(Kernels, ApodisationIsTheKernelsTransform) {
    for (const Kernel &kernel : everyKernel())
        for (const double x : {0.0, 0.0625, -0.23, 1.0 / 3.0, 1.2}) {
            double sum =
                0.0; // midpoint rule: jumps between pieces, 1e-2 at most, cost a step, 2e-4
            const int steps = 40000;
            for (int n = 0; n < steps; ++n) {
                const double t = kernel.width() * ((n + 0.5) / steps - 0.5);
                sum += kernel.value(t) * std::cos(2.0 * std::numbers::pi * t * x);
            }
            EXPECT_NEAR(kernel.apodisation(x), sum * kernel.width() / steps, 2e-6)
                << kernel.name() << " " << x;
        }
}

// The sources' kernels in closed form.
TEST(Kernels, HaveTheTextbookShapes) {
    EXPECT_EQ(Kernel::nearest().value(0.3), 1.0);
    EXPECT_NEAR(Kernel::trilinear().value(-0.25), 0.75, 1e-12);
    EXPECT_NEAR(Kernel::catmullRom().value(0.5), 9.0 / 16.0, 1e-12);
    EXPECT_NEAR(Kernel::catmullRom().value(1.5), -1.0 / 16.0, 1e-12);
    EXPECT_NEAR(Kernel::cubicBSpline().value(0.0), 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(Kernel::cubicBSpline().value(1.0), 1.0 / 6.0, 1e-12);
    // At whole numbers the windowed sinc vanishes; a degree-9 fit leaves 1e-6.
    EXPECT_NEAR(Kernel::hammingSinc().value(1.0), 0.0, 1e-5);
    EXPECT_NEAR(Kernel::hammingSinc().value(0.5),
                2.0 / std::numbers::pi *
                    (25.0 / 46.0 + 21.0 / 46.0 * std::cos(std::numbers::pi / 5.0)),
                1e-5);
}

// sqrt of the energy in the aliases of a field that fills its axis evenly, one by one, and summed
// up in phase for frequencies on the grid and for those that read a tap on the kernel's edge.
double aliases(const Kernel &kernel, double padding) {
    double sum = 0.0;
    const int positions = 64, width = kernel.width();
    for (int n = 0; n < positions; ++n) {
        const double x = (n + 0.5) / positions / (2.0 * padding);
        const double h = kernel.apodisation(x);
        for (const int m : {-3, -2, -1, 1, 2, 3}) {
            const double r = kernel.apodisation(x + m) / h;
            sum += r * r / positions;
        }
        for (const double c : {-0.5, 0.0}) {
            if (c == 0.0 && width % 2 == 0)
                continue; // halfway between grid points nothing lies on an edge
            std::complex<double> taps = 0.0;
            for (int k = 0; k < width; ++k) {
                const double t = c + k - 0.5 * (width - 1);
                taps += kernel.value(t) * std::polar(1.0, 2.0 * std::numbers::pi * t * x);
            }
            sum += std::norm(taps / h - 1.0) / positions;
        }
    }
    return std::sqrt(sum);
}

// The reason for the least-squares kernels: about half of the error of ES and KB.
TEST(Kernels, LeastAliasingHasLeast) {
    for (const double padding : {1.25, 1.5, 2.0})
        for (int w = 2; w <= 7; ++w) {
            const double least = aliases(Kernel::leastAliasing(w, padding), padding);
            EXPECT_LT(least, aliases(Kernel::exponentialSemicircle(w, padding), padding)) << w;
            EXPECT_LT(least, aliases(Kernel::kaiserBessel(w, padding), padding)) << w;
        }
    EXPECT_LT(aliases(Kernel::leastAliasing(4, 1.5), 1.5),
              0.5 * aliases(Kernel::exponentialSemicircle(4, 1.5), 1.5));
}

TEST(Kernels, OfTheLeastAliasingAreSharedByPaddingsWithinAnEighth) {
    EXPECT_EQ(Kernel::leastAliasing(5, 1.55).pairs(), Kernel::leastAliasing(5, 1.5).pairs());
    EXPECT_NE(Kernel::leastAliasing(5, 1.49).pairs(), Kernel::leastAliasing(5, 1.5).pairs());
}

TEST(Kernels, NamesRoundTripAndBadOnesAreRefused) {
    for (const char *name :
         {"nearest", "trilinear", "catmull-rom", "b-spline", "hamming-sinc", "ES4", "KB7", "LS2"})
        EXPECT_EQ(fourier::kernelName(fourier::kernelFromName(name)), name);
    EXPECT_EQ(fourier::kernelName(fourier::kernelFromName("ls5")), "LS5");
    for (const char *name : {"", "ES", "ES8", "LS1", "lanczos", "ES44"})
        EXPECT_THROW(fourier::kernelFromName(name), task::Error) << name;
}

} // namespace
} // namespace pellucid
