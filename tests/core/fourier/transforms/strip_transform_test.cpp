// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <complex>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

#include <hwy/targets.h>

#include "core/fourier/binary16.h"
#include "core/fourier/reasons.h"
#include "core/fourier/transforms/strip_copies.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/system/page_memory.h"

namespace pellucid {

namespace {

using fourier::stripFloats;
using fourier::stripLanes;

// Runs a transform whose inputs are random up to `outer` on both sides; the strips between are NaN,
// which would show in the result if they were read.
void expectTheSum(int length, int outer) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto bytes = std::size_t(length) * stripFloats * sizeof(float);
    const auto a = system::allocatePages(bytes, task::because::aSpectrum),
               b = system::allocatePages(bytes, task::because::aSpectrum);
    auto *data = reinterpret_cast<float *>(a.get());
    std::vector<float> in;
    for (int n = 0; n < length; ++n) {
        const bool isZero = n > outer && n < length - outer;
        for (int lane = 0; lane < stripFloats; ++lane) {
            in.push_back(isZero ? 0.0F : uniform(random));
            data[std::size_t(n) * stripFloats + lane] =
                isZero ? std::numeric_limits<float>::quiet_NaN() : in.back();
        }
    }
    const fourier::StripTransform transform(length);
    const float *const out = transform.run(data, reinterpret_cast<float *>(b.get()), outer);
    for (int k = 0; k < length; ++k)
        for (const int lane : {0, 7, 15}) {
            std::complex<double> sum = 0.0;
            for (int n = 0; n < length; ++n)
                sum += std::complex<double>(in[std::size_t(n) * stripFloats + lane],
                                            in[std::size_t(n) * stripFloats + 16 + lane]) *
                       std::polar(1.0, 2.0 * std::numbers::pi * n * k / length);
            // Rounding grows as the root of the number of terms and of stages.
            const double allowed = 5e-7 * std::sqrt(length) * (1.0 + std::log2(length));
            EXPECT_NEAR(out[std::size_t(k) * stripFloats + lane], sum.real(), allowed)
                << length << ' ' << outer;
            EXPECT_NEAR(out[std::size_t(k) * stripFloats + 16 + lane], sum.imag(), allowed)
                << length << ' ' << outer;
        }
}

template <class F> void withEachInstructionSet(const F &check) {
    const std::int64_t all = hwy::SupportedTargets();
    for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(hwy::TargetName(rest & -rest));
        check();
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
}

TEST(StripTransform, IsTheSumForEveryRadix) {
    withEachInstructionSet([] {
        for (const int length :
             {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 15, 16, 18, 27, 30, 35, 48, 63, 84, 96, 162, 210, 384})
            expectTheSum(length, length / 2);
    });
}

TEST(StripTransform, SkipsZerosBetweenTheEnds) {
    withEachInstructionSet([] {
        for (const int length : {2, 3, 4, 5, 7, 8, 9, 12, 30, 35, 64, 90, 96, 210})
            for (int outer = 0; outer < length / 2; outer += 1 + length / 16)
                expectTheSum(length, outer);
    });
}

TEST(Binary16, EveryFiniteNumberRoundTrips) {
    for (std::uint32_t half = 0; half < 0x10000U; ++half)
        if ((half & 0x7c00U) != 0x7c00U) {
            EXPECT_EQ(fourier::toBinary16(fourier::fromBinary16(std::uint16_t(half))), half);
        }
    EXPECT_EQ(fourier::fromBinary16(0x3c00), 1.0F);
    EXPECT_EQ(fourier::fromBinary16(0x0001), 0x1p-24F);
    EXPECT_EQ(fourier::fromBinary16(0xfbff), -65504.0F);
}

TEST(Binary16, RoundsToNearestEven) {
    EXPECT_EQ(fourier::toBinary16(1.0F + 0x1p-11F), 0x3c00); // half way: to even
    EXPECT_EQ(fourier::toBinary16(1.0F + 0x3p-11F), 0x3c02);
    EXPECT_EQ(fourier::toBinary16(1.0F + 0x1.2p-11F), 0x3c01);
    EXPECT_EQ(fourier::toBinary16(0x1p-25F), 0x0000); // half of the smallest: to even
    EXPECT_EQ(fourier::toBinary16(-0x1.8p-25F), 0x8001);
}

TEST(Binary16, StripsAreRoundedAsSingleNumbersAre) {
    alignas(64) std::array<float, stripFloats> strip;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> exponent(-26.0F, 15.0F);
    for (int round = 0; round < 500; ++round) {
        for (float &f : strip)
            f = std::exp2(exponent(random)) * (random() % 2 != 0U ? 1.0F : -1.0F);
        std::array<std::uint32_t, stripLanes> cells{};
        fourier::storeExchanged(strip.data(), 1, 1.0F, cells.data(), stripLanes);
        for (int lane = 0; lane < stripLanes; ++lane) {
            EXPECT_EQ(cells[lane] & 0xffffU, fourier::toBinary16(strip[stripLanes + lane]));
            EXPECT_EQ(cells[lane] >> 16, fourier::toBinary16(strip[lane]));
        }
    }
}

} // namespace
} // namespace pellucid
