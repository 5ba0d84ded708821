// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/edge_tails.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/accuracy/coarse_plane.h"

namespace pellucid::accuracy {

namespace {

constexpr double pi = std::numbers::pi;

// The energy that the roll-off leaves of the response of a sharp disc, at u = roll-off times
// distance in pixels: (cos(pi u/2) / (1 - u^2))^2, with the mean of the oscillation where it is
// fast.
double rollOffTail(double u) {
    if (std::abs(u - 1.0) < 1e-3)
        return pi * pi / 16.0;
    const double squared = u < 1.5 ? std::pow(std::cos(0.5 * pi * u), 2) : 0.5;
    return squared / std::pow(1.0 - u * u, 2);
}

// The integral over the distance from a point, in one direction, of the squared response r^2 times
// its energy per angle, where tails come back into the picture.
double foldedAlong(glm::dvec2 fromMm, glm::dvec2 direction, const PeriodicWindow &window,
                   double rollOff) {
    constexpr int steps = 64;
    const double step = glm::length(window.periodMm) / window.pixelMm / steps;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double r = (k + 0.5) * step, u = rollOff * r; // pixels
        const glm::dvec2 at = fromMm + r * window.pixelMm * direction;
        const bool isBeside =
            std::abs(at.x) > 0.5 * window.windowMm.x || std::abs(at.y) > 0.5 * window.windowMm.y;
        if (isBeside && CoarsePlane::isWithin(at.x, window.periodMm.x, window.windowMm.x) &&
            CoarsePlane::isWithin(at.y, window.periodMm.y, window.windowMm.y)) {
            sum += step * rollOffTail(u) / (r * r);
        }
    }
    return sum;
}

} // namespace

void ProjectedPlaces::add(glm::dvec2 atMm, glm::dvec2 periodMm, double energy) {
    const auto bin = [&](int axis) {
        return std::clamp(int(0.5 * side * (atMm[axis] / periodMm[axis] + 1.0)), 0, side - 1);
    };
    Place &place = m_places[std::size_t(bin(1) * side + bin(0))];
    place.energy += energy;
    place.momentMm += energy * atMm;
}

double edgeTails(const ProjectedPlaces &places, const PeriodicWindow &window, double rollOff,
                 const std::array<double, SliceEnergies::directions> &edge) {
    constexpr double radius = 0.5; // of the disc, cycles per pixel
    double all = 0.0, folded = 0.0;
    for (const ProjectedPlaces::Place &place : places.places()) {
        if (!(place.energy > 0.0))
            continue;
        all += place.energy;
        for (int n = 0; n < 2 * SliceEnergies::directions; ++n) {
            const double angle = pi * (n + 0.5) / SliceEnergies::directions;
            folded += place.energy * edge[std::size_t(n % SliceEnergies::directions)] *
                      foldedAlong(place.momentMm / place.energy, {std::cos(angle), std::sin(angle)},
                                  window, rollOff);
        }
    }
    // A point of energy A per area of the disc has the mean squared response A radius / (2 pi^2
    // r^3).
    return all > 0.0 ? folded / all * (pi / SliceEnergies::directions) * radius / (2.0 * pi * pi)
                     : 0.0;
}

} // namespace pellucid::accuracy
