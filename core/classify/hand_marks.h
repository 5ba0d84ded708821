// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/volume/lattice.h"

namespace pellucid::classify {

/// What a ball covers that moves along a path. It belongs to the class, or is erased from it.
struct Stroke {
    std::vector<volume::PatientPoint> path; ///< one point: the ball alone
    double radiusMm = 5.0;
    bool erases = false;
    bool operator==(const Stroke &) const = default;
};

/// A cut along the line of sight: the prism over an outline, which may cross itself.
struct LassoCut {
    /// The corners, each at any depth.
    std::vector<volume::PatientPoint> outline;
    glm::dvec3 sight{0.0, 0.0, 1.0}; ///< the direction of the line of sight, a unit vector, LPS
    /// The part of the prism whose positions, projected on `sight`, are between these; not set: all
    /// of it. *Units*: mm.
    std::optional<std::array<double, 2>> slabMm;
    bool keeps = false; ///< the prism is kept, not removed
    bool operator==(const LassoCut &) const = default;
};

/// Limits of what a file may contain: hours of work by hand.
inline constexpr std::size_t maxPoints = 10000, maxStrokes = 10000;
inline constexpr double smallestBallMm = 0.1, largestBallMm = 200.0;

/// *Throws* Error{usage} for a path without points, a ball out of range, or a place that is not
/// finite.
void validate(const Stroke &stroke);
/// *Throws* Error{usage} for fewer than three corners, a direction that is no unit vector, or a
/// place that is not finite.
void validate(const LassoCut &cut);

} // namespace pellucid::classify
