// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/volume/lattice.h"

namespace pellucid::classify {

/// Places in the patient in their order. Copies share them: each state that an undo can restore has
/// all marks. A copy that is extended gets its own.
class Path {
public:
    Path() = default;
    Path(std::initializer_list<volume::PatientPoint> points)
        : Path(std::vector<volume::PatientPoint>(points)) {}
    explicit Path(std::vector<volume::PatientPoint> points)
        : m_points(std::make_shared<std::vector<volume::PatientPoint>>(std::move(points))) {}

    std::size_t size() const { return m_points ? m_points->size() : 0; }
    bool empty() const { return size() == 0; }
    const volume::PatientPoint &operator[](std::size_t n) const { return (*m_points)[n]; }
    const volume::PatientPoint *begin() const { return m_points ? m_points->data() : nullptr; }
    const volume::PatientPoint *end() const { return begin() + size(); }
    void push_back(const volume::PatientPoint &point) {
        if (!m_points || m_points.use_count() > 1)
            m_points = std::make_shared<std::vector<volume::PatientPoint>>(begin(), end());
        m_points->push_back(point);
    }
    bool operator==(const Path &other) const {
        return m_points == other.m_points ||
               (size() == other.size() && std::equal(begin(), end(), other.begin()));
    }

private:
    std::shared_ptr<std::vector<volume::PatientPoint>> m_points; ///< null: none
};

/// A stroke of a ball-shaped brush along a path, which adds to a class or erases from it.
struct Stroke {
    Path path; ///< one point: the ball alone
    double radiusMm = 5.0;
    bool erases = false;
    bool operator==(const Stroke &) const = default;
};

/// A cut along the line of sight: the prism over an outline, which may cross itself.
struct LassoCut {
    /// The corners, each at any depth.
    Path outline;
    glm::dvec3 sight{0.0, 0.0, 1.0}; ///< the direction of the line of sight, a unit vector, LPS
    /// The part of the prism whose positions, projected on `sight`, are between these; not set: all
    /// of it. *Units*: mm.
    std::optional<std::array<double, 2>> slabMm;
    bool keeps = false; ///< the prism is kept, not removed
    bool operator==(const LassoCut &) const = default;
};

/// The most that a file may contain: hours of manual work.
inline constexpr std::size_t maxPoints = 10000, maxStrokes = 10000;
inline constexpr double smallestBallMm = 0.1, largestBallMm = 200.0;

/// *Throws* Error{usage} for a path without points, a ball out of range, or a place that is not
/// finite.
void validate(const Stroke &stroke);
/// *Throws* Error{usage} for fewer than three corners, a direction that is no unit vector, or a
/// place that is not finite.
void validate(const LassoCut &cut);

} // namespace pellucid::classify
