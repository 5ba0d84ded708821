// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "core/volume/lattice.h"

namespace pellucid::mpr {

/// The three planes of the patient, which stay perpendicular to each other when they are rotated.
enum class Orientation { axial, coronal, sagittal };

inline constexpr std::array<Orientation, 3> allOrientations{
    Orientation::axial, Orientation::coronal, Orientation::sagittal};

/// Image axes in patient space. *Units*: perpendicular unit vectors, LPS.
struct Axes {
    glm::dvec3 right{1, 0, 0}, up{0, 0, 1};

    glm::dvec3 toViewer() const;
    bool operator==(const Axes &) const = default;
};

/// Image axes in radiological convention: axial seen from the feet (patient right at image left,
/// anterior up), coronal from the front, sagittal from the left (anterior at image left).
Axes standardAxes(Orientation orientation);

/// The normal along which a plane is scrolled: superior, posterior or left for standard axes.
glm::dvec3 scrollAxis(const Axes &axes, Orientation orientation);

/// The axes of the three planes, in the order of `Orientation`.
class PlaneAxes {
public:
    PlaneAxes();
    /// *Throws* Error{usage} unless right and up of each are perpendicular unit vectors, and the
    /// three planes are perpendicular to each other.
    explicit PlaneAxes(const std::array<Axes, 3> &axes);

    const Axes &of(Orientation orientation) const { return m_axes[std::size_t(orientation)]; }
    glm::dvec3 scrollAxis(Orientation orientation) const;
    bool areStandard() const { return *this == PlaneAxes(); }
    /// Rotates the other two about the normal of this one, whose picture stays the same. *Units*:
    /// rad, counterclockwise in that picture.
    PlaneAxes turned(Orientation about, double angleRad) const;
    /// Rotated together so that the plane closest to `wanted` gets its normal.
    PlaneAxes facing(const Axes &wanted) const;
    /// The planes of a scan: the one closest to its slices shows them as they were acquired, row by
    /// row; the others are perpendicular to it.
    static PlaneAxes along(const volume::Lattice &lattice);

    bool operator==(const PlaneAxes &) const = default;

private:
    std::array<Axes, 3> m_axes;
};

/// A rectangle of pixels in patient space. Pixel (row r, column c) is centred at center + (c -
/// (width-1)/2) pixel right + ((height-1)/2 - r) pixel up.
struct Plane {
    volume::PatientPoint center;
    Axes axes;
    double pixelMm = 1.0;
    int width = 1, height = 1;

    volume::PatientPoint at(double column, double row) const;
    /// Column and row of a point's orthogonal projection onto the plane.
    glm::dvec2 pixel(volume::PatientPoint point) const;
};

/// The range of the lattice along a normal, mm, and the step between slices: the smallest distance
/// that reaches a new sample. If the normal is that of a face of the lattice's cells, slices are at
/// whole steps from `lowMm`.
struct ScrollRange {
    double lowMm = 0.0, highMm = 0.0, stepMm = 1.0;
    bool hasSlices = false;

    /// The position after this many steps: on a slice if there are any, and within the range.
    double moved(double positionMm, int steps) const;
};
ScrollRange scrollRange(const volume::Lattice &lattice, const glm::dvec3 &normal);

} // namespace pellucid::mpr
