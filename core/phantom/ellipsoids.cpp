// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/phantom/ellipsoids.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace pellucid::phantom {

using glm::dvec3;

double inscribedRadiusMm(const volume::Lattice &lattice) {
    double radius = 1e300;
    for (int d = 0; d < 3; ++d) {
        const dvec3 normal =
            glm::normalize(glm::cross(lattice.step((d + 1) % 3), lattice.step((d + 2) % 3)));
        radius =
            std::min(radius, 0.5 * lattice.size()[d] * std::abs(glm::dot(normal, lattice.step(d))));
    }
    return radius;
}

std::vector<SmoothEllipsoid> smoothEllipsoids(double r) {
    const auto turn = [](double deg, dvec3 axis) {
        return glm::angleAxis(glm::radians(deg), glm::normalize(axis));
    };
    return {{{0, 0, 0}, {0.80 * r, 0.92 * r, 0.70 * r}, turn(0, {0, 0, 1}), 1100.0, 4},
            {{0.25 * r, -0.20 * r, 0.15 * r},
             {0.40 * r, 0.50 * r, 0.45 * r},
             turn(35, {1, 1, 0}),
             700.0,
             4},
            {{-0.30 * r, 0.20 * r, -0.10 * r},
             {0.45 * r, 0.38 * r, 0.50 * r},
             turn(-50, {0, 1, 1}),
             600.0,
             4},
            {{0.05 * r, 0.35 * r, 0.25 * r},
             {0.36 * r, 0.40 * r, 0.34 * r},
             turn(20, {1, 0, 1}),
             -150.0,
             4}};
}

double densityAt(const std::vector<SmoothEllipsoid> &bodies, const dvec3 &mm) {
    double sum = 0.0;
    for (const SmoothEllipsoid &b : bodies) {
        const dvec3 unit = (glm::conjugate(b.rotation) * (mm - b.centerMm)) / b.radiiMm;
        const double inside = 1.0 - glm::dot(unit, unit);
        if (inside > 0.0)
            sum += b.amplitudeHu * std::pow(inside, b.exponent);
    }
    return sum;
}

double lineIntegral(const std::vector<SmoothEllipsoid> &bodies, const dvec3 &pointMm,
                    const dvec3 &direction) {
    double sum = 0.0;
    for (const SmoothEllipsoid &b : bodies) {
        const glm::dquat back = glm::conjugate(b.rotation);
        const dvec3 p = (back * (pointMm - b.centerMm)) / b.radiiMm;
        const dvec3 w = (back * direction) / b.radiiMm;
        const double speed = glm::length(w);
        const double along = glm::dot(p, w) / speed;
        const double u = 1.0 - (glm::dot(p, p) - along * along);
        if (u > 0.0)
            sum += b.amplitudeHu / speed * std::pow(u, b.exponent + 0.5) *
                   std::beta(0.5, b.exponent + 1.0);
    }
    return sum;
}

} // namespace pellucid::phantom
