// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/transfer_function.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/classify/reasons.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

// Solves the least squares problem in the Bernstein basis within a box by coordinate descent. The
// matrix is positive definite, so the descent converges to the minimum.
std::vector<double> boxedLeastSquares(const std::vector<std::vector<double>> &matrix,
                                      const std::vector<double> &right, double largest) {
    std::vector<double> x(right.size(), 0.5 * largest);
    for (int round = 0; round < 20000; ++round) {
        double change = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            double residual = right[i];
            for (std::size_t j = 0; j < x.size(); ++j)
                residual -= matrix[i][j] * x[j];
            const double next = std::clamp(x[i] + residual / matrix[i][i], 0.0, largest);
            change = std::max(change, std::abs(next - x[i]));
            x[i] = next;
        }
        if (change < 1e-12)
            break;
    }
    return x;
}

} // namespace

double bernstein(int index, int degree, double f) {
    double value = 1.0;
    for (int n = 1; n <= index; ++n)
        value *= f * (degree - index + n) / n;
    for (int n = 0; n < degree - index; ++n)
        value *= 1.0 - f;
    return value;
}

double TransferFunction::at(double f) const {
    const double g = std::clamp((f - low) / (high - low), 0.0, 1.0);
    double sum = 0.0;
    for (int i = 0; i <= degree(); ++i)
        sum += weights[std::size_t(i)] * bernstein(i, degree(), g);
    return sum;
}

bool TransferFunction::isPlain() const {
    return std::all_of(weights.begin(), weights.end(), [](double w) { return w == 1.0; });
}

void validate(const TransferFunction &function) {
    constexpr double rounded = 1.0 - 1e-9; // a difference of rounded ends
    const int points = int(function.weights.size());
    if (points < TransferFunction::minPoints || points > TransferFunction::maxPoints)
        throw task::Error(task::ErrorCode::usage,
                          task::because::weightsOutOfRange(TransferFunction::minPoints,
                                                           TransferFunction::maxPoints, points));
    if (!(function.low >= 0.0 && function.high <= 1.0 &&
          function.high - function.low >= rounded * TransferFunction::narrowestRange))
        throw task::Error(task::ErrorCode::usage, task::because::curveRangeInvalid(fmt::format(
                                                      "{:g}", TransferFunction::narrowestRange)));
    for (const double weight : function.weights)
        if (!(weight >= 0.0 && weight <= TransferFunction::largestWeight))
            throw task::Error(task::ErrorCode::usage,
                              task::because::weightOutOfRange(
                                  fmt::format("{:g}", weight),
                                  fmt::format("{:g}", TransferFunction::largestWeight)));
}

FittedTransferFunction fitTransferFunction(const std::function<double(double)> &curve, int points,
                                           const std::function<double(double)> &importance) {
    const auto n = std::size_t(points);
    constexpr int samples = 1024;
    std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0.0));
    std::vector<double> right(n, 0.0), basis(n);
    for (int s = 0; s <= samples; ++s) {
        const double f = double(s) / samples, value = curve(f);
        const double share = importance ? importance(f) : 1.0;
        for (std::size_t i = 0; i < n; ++i)
            basis[i] = bernstein(int(i), points - 1, f);
        for (std::size_t i = 0; i < n; ++i) {
            right[i] += share * basis[i] * value;
            for (std::size_t j = 0; j < n; ++j)
                matrix[i][j] += share * basis[i] * basis[j];
        }
    }
    FittedTransferFunction fitted{
        {boxedLeastSquares(matrix, right, TransferFunction::largestWeight)}};
    for (int s = 0; s <= samples; ++s) {
        const double f = double(s) / samples;
        fitted.largestError =
            std::max(fitted.largestError, std::abs(fitted.function.at(f) - curve(f)));
    }
    return fitted;
}

namespace {

// The closest curve with these points over a range.
TransferFunction fitted(const TransferFunction &function, int points, double low, double high) {
    TransferFunction closest =
        fitTransferFunction([&](double g) { return function.at(low + g * (high - low)); }, points)
            .function;
    closest.low = low;
    closest.high = high;
    return closest;
}

} // namespace

TransferFunction withPoints(const TransferFunction &function, int points) {
    std::vector<double> weights = function.weights;
    if (points < int(weights.size()))
        return fitted(function, points, function.low, function.high);
    while (int(weights.size()) < points) {
        // The control points of the next degree are on the sides of the control polygon.
        std::vector<double> raised(weights.size() + 1);
        raised.front() = weights.front();
        raised.back() = weights.back();
        for (std::size_t i = 1; i < weights.size(); ++i) {
            const double share = double(i) / double(weights.size());
            raised[i] = share * weights[i - 1] + (1.0 - share) * weights[i];
        }
        weights = std::move(raised);
    }
    return {weights, function.low, function.high};
}

TransferFunction withRange(const TransferFunction &function, double low, double high) {
    const std::vector<double> &weights = function.weights;
    if (std::equal(weights.begin() + 1, weights.end(), weights.begin())) // all are the same
        return {weights, low, high};
    return fitted(function, int(weights.size()), low, high);
}

} // namespace pellucid::classify
