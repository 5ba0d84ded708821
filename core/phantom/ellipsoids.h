// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/volume/volume.h"

namespace pellucid::phantom {

/// amplitude (1 - r^2)^exponent inside an ellipsoid, where r is the normalised radius: smooth
/// enough at the surface to be sampled without aliasing, with line integrals in closed form.
struct SmoothEllipsoid {
    glm::dvec3 centerMm{0.0};
    glm::dvec3 radiiMm{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double amplitudeHu = 0.0;
    int exponent = 4;
};

/// The ellipsoids of the phantom, scaled to fit a lattice with the given radius of its inscribed
/// sphere.
std::vector<SmoothEllipsoid> smoothEllipsoids(double inscribedRadiusMm);

/// Their sum at a point. *Units*: HU above the background.
double densityAt(const std::vector<SmoothEllipsoid> &bodies, const glm::dvec3 &mm);

/// The integral of their sum along the line through `point` with unit `direction`. *Units*: HU mm.
/// With u = 1 - d^2 (d: the line's distance from the centre in normalised space) it is amplitude l
/// u^(n+1/2) B(1/2, n+1), where l is the length of one normalised unit along the line.
double lineIntegral(const std::vector<SmoothEllipsoid> &bodies, const glm::dvec3 &pointMm,
                    const glm::dvec3 &direction);

/// Background of the sampled ellipsoid phantom. With a window that starts here, the field equals
/// the densities.
inline constexpr double ellipsoidBackgroundHu = -1000.0;

/// Radius of the largest sphere about the lattice's centre that is inside it, mm.
double inscribedRadiusMm(const volume::Lattice &lattice);

} // namespace pellucid::phantom
