// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace pellucid::classify {

/// b_i(f) = C(degree, i) f^i (1 - f)^(degree - i), 0 <= i <= degree.
double bernstein(int index, int degree, double f);

/// The weight of a density: B(f) = sum_i P_i b_i(g), a Bézier curve whose n control points are
/// above g = i/(n - 1), where g goes from 0 to 1 over the range of the curve, by default all
/// densities. Beyond the range, the weights are those of its ends: a narrow range tells fat from
/// muscle, which are close together among the densities of a CT. The projected quantity is the
/// product f B(f); if all weights are 1, the density is unchanged. The product has n times the
/// bandwidth, and sampling aliases it: the field is defined by these samples. *Source*: Cheng 2007,
/// eq. 34 to 36.
struct TransferFunction {
    static constexpr int minPoints = 2, maxPoints = 16;
    static constexpr double largestWeight = 2.0, narrowestRange = 0.01;

    std::vector<double> weights = std::vector<double>(6, 1.0); ///< P_i, 0..largestWeight
    double low = 0.0, high = 1.0;                              ///< the range of densities

    int degree() const { return int(weights.size()) - 1; }
    double at(double f) const;
    /// Whether it leaves every density unchanged.
    bool isPlain() const;
    /// Whether the range is all densities.
    bool isWhole() const { return low == 0.0 && high == 1.0; }
    bool operator==(const TransferFunction &) const = default;
};

/// *Throws* Error{usage} naming the value that is out of range.
void validate(const TransferFunction &function);

/// A curve as a transfer function, with its largest error.
struct FittedTransferFunction {
    TransferFunction function;
    double largestError = 0.0; ///< of the weights over f in 0..1
};

/// The weights within 0..largestWeight with the least mean square distance from a curve over 0..1.
/// Each part of the curve is weighted by `importance`; without it all parts count equally.
FittedTransferFunction fitTransferFunction(const std::function<double(double)> &curve, int points,
                                           const std::function<double(double)> &importance = {});

/// The same curve with more control points, exactly; or the closest one with fewer.
TransferFunction withPoints(const TransferFunction &function, int points);

/// The closest curve over a different range with as many points; exact if all weights are equal.
/// *Requires*: a valid range.
TransferFunction withRange(const TransferFunction &function, double low, double high);

} // namespace pellucid::classify
