// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/classify/shown_fields.h"
#include "core/classify/transfer_function.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using classify::TransferFunction;

TransferFunction alternating(int points) {
    TransferFunction function{std::vector<double>(std::size_t(points))};
    for (int i = 0; i < points; ++i)
        function.weights[std::size_t(i)] = i % 2 == 0 ? 0.0 : 2.0;
    return function;
}

TEST(TransferFunction, BernsteinPolynomialsSumToOne) {
    for (int degree = 1; degree < TransferFunction::maxPoints; ++degree)
        for (const double f : {0.0, 0.1, 0.5, 0.77, 1.0}) {
            double sum = 0.0, mean = 0.0;
            for (int i = 0; i <= degree; ++i) {
                sum += classify::bernstein(i, degree, f);
                mean += i * classify::bernstein(i, degree, f);
            }
            EXPECT_NEAR(sum, 1.0, 1e-14);
            EXPECT_NEAR(mean, degree * f, 1e-13); // they are the binomial distribution
        }
}

TEST(TransferFunction, CubicOfTheThesis) {
    // Four points: (1-f)^3 P0 + 3 f (1-f)^2 P1 + 3 f^2 (1-f) P2 + f^3 P3.
    const TransferFunction function{{0.5, 2.0, 0.0, 1.5}};
    for (const double f : {0.0, 0.2, 0.6, 1.0})
        EXPECT_NEAR(function.at(f),
                    0.5 * std::pow(1 - f, 3) + 6.0 * f * std::pow(1 - f, 2) + 1.5 * f * f * f,
                    1e-14);
}

TEST(TransferFunction, MorePointsHoldTheSameCurveAndBackAgain) {
    const TransferFunction function{{0.3, 1.7, 0.2, 1.0}};
    const TransferFunction raised = classify::withPoints(function, 9);
    ASSERT_EQ(raised.weights.size(), 9U);
    for (int n = 0; n <= 50; ++n)
        EXPECT_NEAR(raised.at(n / 50.0), function.at(n / 50.0), 1e-14);
    const TransferFunction lowered = classify::withPoints(raised, 4);
    // The descent stops when its steps are below 1e-12; the system's condition is below 1e3.
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(lowered.weights[i], function.weights[i], 1e-8);
}

TEST(TransferFunction, ARangeHoldsTheWholeCurveAndItsEndsBeyond) {
    const TransferFunction whole{{0.3, 1.7, 0.2, 1.0}};
    const TransferFunction part{whole.weights, 0.4, 0.5};
    for (int n = 0; n <= 50; ++n)
        EXPECT_NEAR(part.at(0.4 + 0.1 * n / 50.0), whole.at(n / 50.0), 1e-12);
    EXPECT_EQ(part.at(0.1), 0.3);
    EXPECT_EQ(part.at(0.9), 1.0);
    EXPECT_FALSE(part.isWhole());
    // Back and forth: the closest curve over a part of itself is itself, as both are cubics.
    const TransferFunction inner = classify::withRange(whole, 0.2, 0.6);
    for (int n = 0; n <= 50; ++n)
        EXPECT_NEAR(inner.at(0.2 + 0.4 * n / 50.0), whole.at(0.2 + 0.4 * n / 50.0), 1e-7);
    // Equal weights stay equal, exactly.
    EXPECT_EQ(classify::withRange({{0.7, 0.7, 0.7}}, 0.1, 0.2).weights,
              (std::vector<double>{0.7, 0.7, 0.7}));
    EXPECT_EQ(classify::withPoints(part, 6).low, 0.4);
    EXPECT_EQ(classify::withPoints(part, 3).high, 0.5);
}

TEST(TransferFunction, InvalidRangesAreRefused) {
    for (const auto &[low, high] :
         {std::pair(-0.1, 0.5), std::pair(0.5, 1.1), std::pair(0.5, 0.5), std::pair(0.6, 0.5),
          std::pair(0.5, 0.509), std::pair(std::nan(""), 0.5), std::pair(0.5, std::nan(""))})
        EXPECT_THROW(classify::validate(TransferFunction{{1.0, 1.0}, low, high}), task::Error)
            << low;
    for (int n = 0; n < 990; ++n) { // the narrowest, wherever it is
        const double low = n / 1000.0;
        EXPECT_NO_THROW(classify::validate(TransferFunction{{1.0, 1.0}, low, low + 0.01})) << low;
    }
}

// The table of a narrow range resolves the steepest curve as well as that of a wide one.
TEST(TransferFunction, ANarrowRangeIsShownAsExactly) {
    std::vector<float> values;
    for (int n = 0; n <= 20000; ++n)
        values.push_back(0.49F + 0.03F * float(n) / 20000.0F);
    const auto count = int(values.size());
    const volume::Volume volume(volume::Lattice::centred({count, 1, 1}, {1.0, 1.0, 1.0}), values,
                                volume::ValueUnit::none);
    TransferFunction function = alternating(16);
    function.low = 0.5;
    function.high = 0.51;
    classify::Look look;
    look.transferFunction = function;
    const auto fields = classify::shownFields(volume, {0.0, 1.0}, look, nullptr);
    double largest = 0.0;
    for (int n = 0; n < count; ++n) {
        const double f = double(values[std::size_t(n)]);
        largest = std::max(
            largest, std::abs(fields.channels[0].values.value({n, 0, 0}) - f * function.at(f)));
    }
    // Chords: 1e-6, see value_curve.cpp; densities of 24 bits near 0.5 in a curve whose slope is at
    // most 15 x 2 / 0.01: 3000 x 3e-8.
    EXPECT_LT(largest, 1e-6 + 1.2e-4);
}

TEST(TransferFunction, FitsStayWithinTheirBoxAndSayHowFarOffTheyAre) {
    const auto step = [](double f) { return f < 0.5 ? 0.0 : 2.0; };
    double before = 3.0;
    for (const int points : {2, 4, 8, 16}) {
        const auto fitted = classify::fitTransferFunction(step, points);
        for (const double weight : fitted.function.weights) {
            EXPECT_GE(weight, 0.0);
            EXPECT_LE(weight, 2.0);
        }
        double worst = 0.0, square = 0.0;
        for (int n = 0; n <= 1024; ++n) {
            const double e = fitted.function.at(n / 1024.0) - step(n / 1024.0);
            worst = std::max(worst, std::abs(e));
            square += e * e;
        }
        EXPECT_NEAR(fitted.largestError, worst, 1e-12);
        EXPECT_LT(square, before * 1024); // more points come closer
        before = square / 1024;
    }
}

TEST(TransferFunction, RefusesWhatIsOutOfRange) {
    for (const auto &weights :
         {std::vector<double>{1.0}, std::vector<double>(17, 1.0), std::vector<double>{1.0, 2.1},
          std::vector<double>{-0.1, 1.0}, std::vector<double>{1.0, std::nan("")}})
        EXPECT_THROW(classify::validate(TransferFunction{weights}), task::Error);
    classify::validate(alternating(16));
}

TEST(TransferFunction, WeightedFieldIsTheDensityTimesTheCurve) {
    const auto field = test::noiseField(test::tiltedLattice({13, 9, 7}, {1, 1, 2}, 20));
    for (const auto &function :
         {TransferFunction{}, alternating(6), alternating(16), TransferFunction{{0.0, 0.0}}}) {
        const auto weighted =
            classify::shownFields(field.values.samples(), {0.0, 1.0}, {function, {}}, nullptr)
                .channels.front();
        for (int n = 0; n < 13 * 9 * 7; ++n) {
            const volume::VoxelIndex at{n % 13, n / 13 % 9, n / 117};
            const double f = field.values.value(at);
            // The table's chords: h^2/8 |(f B)''| <= 1/16384^2/8 * 2*2*15*14 = 4e-7, and rounding.
            EXPECT_NEAR(weighted.values.value(at), f * function.at(f), 8e-7);
        }
    }
    const auto nothing = classify::shownFields(field.values.samples(), {0.0, 1.0},
                                               {TransferFunction{{0.0, 0.0}}, {}}, nullptr)
                             .channels.front();
    EXPECT_EQ(nothing.support.size().count(), 1U);
}

} // namespace
} // namespace pellucid
