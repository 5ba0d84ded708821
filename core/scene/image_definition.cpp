// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/image_definition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::scene {

namespace {

double sinc(double q) {
    const double x = std::numbers::pi * q;
    // The series' next term, x^4/120, is below rounding here.
    return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

} // namespace

double rollOffFactor(double rollOff, double q) {
    if (q >= 1.0)
        return 0.0;
    if (q <= 1.0 - rollOff)
        return 1.0;
    return 0.5 * (1.0 + std::cos(std::numbers::pi * (q - (1.0 - rollOff)) / rollOff));
}

double detailFactor(const ImageDefinition &definition, double perMm) {
    const double x = 2.0 * std::numbers::pi * definition.detailMm * perMm, u = x * x;
    return 1.0 + definition.detail * u / (1.0 + u);
}

double defaultDetailMm(double radiusMm) {
    constexpr double humanMm = 2.0, leastMm = 0.01, radiusShare = 1.0 / 8.0;
    return std::clamp(radiusShare * radiusMm, leastMm, humanMm);
}

double detailGain(const ImageDefinition &definition) {
    return 1.0 + definition.detail;
}

double reconstructionFactor(const ImageDefinition &definition, double q) {
    const double s = sinc(q);
    switch (definition.reconstruction) {
    case Reconstruction::linear:
        return s * s;
    case Reconstruction::bandLimited:
        return rollOffFactor(definition.rollOff, 2.0 * std::abs(q));
    case Reconstruction::cubic:
        return s * s * (3.0 * s * s - 2.0 * sinc(2.0 * q));
    case Reconstruction::spline:
        break;
    }
    return 3.0 * s * s * s * s / (2.0 + std::cos(2.0 * std::numbers::pi * q));
}

double reconstructionReach(const ImageDefinition &definition) {
    switch (definition.reconstruction) {
    case Reconstruction::linear:
        return 1.0;
    case Reconstruction::cubic:
        return 2.0;
    case Reconstruction::bandLimited:
        return 2.0 / std::max(1.0 / 64.0, definition.rollOff);
    case Reconstruction::spline:
        break;
    }
    return 6.0;
}

} // namespace pellucid::scene
