// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace pellucid::classify {

/// b_i(f) = C(degree, i) f^i (1 - f)^(degree - i), 0 <= i <= degree.
double bernstein(int index, int degree, double f);

/// The weight that a density is shown with: B(f) = sum_i P_i b_i(f), a Bézier curve over f in 0..1
/// whose n control points lie above i/(n - 1). It multiplies: what is projected is f B(f). All
/// weights 1 leave the density as it is. The product has an n-fold band and the samples alias it:
/// these samples are what the field is. *Source*: Cheng 2007, eq. 34 to 36.
struct TransferFunction {
    static constexpr int fewestPoints = 2, mostPoints = 16;
    static constexpr double largestWeight = 2.0;

    std::vector<double> weights = std::vector<double>(6, 1.0); ///< P_i, 0..largestWeight

    int degree() const { return int(weights.size()) - 1; }
    double at(double f) const;
    /// Whether it leaves every density as it is.
    bool isPlain() const;
    bool operator==(const TransferFunction &) const = default;
};

/// *Throws* Error{usage} naming what is out of its range.
void validate(const TransferFunction &function);

/// A curve as a transfer function, and how far off it is.
struct FittedTransferFunction {
    TransferFunction function;
    double largestError = 0.0; ///< of the weights over f in 0..1
};

/// The weights within 0..largestWeight with the least mean square distance from a curve over 0..1,
/// each part of the curve counting by its importance: the same everywhere if none is given.
FittedTransferFunction fitTransferFunction(const std::function<double(double)> &curve, int points,
                                           const std::function<double(double)> &importance = {});

/// The same curve held by more control points, exactly; or the nearest one held by fewer.
TransferFunction withPoints(const TransferFunction &function, int points);

} // namespace pellucid::classify
