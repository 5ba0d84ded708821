// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "core/volume/lattice.h"

namespace pellucid::mpr {

/// The three planes of the patient, which stay at right angles to each other when they are turned.
enum class Orientation { axial, coronal, sagittal };

inline constexpr std::array<Orientation, 3> allOrientations{
    Orientation::axial, Orientation::coronal, Orientation::sagittal};

/// Image axes in the patient. *Units*: unit vectors of LPS, at right angles.
struct Axes {
    glm::dvec3 right{1, 0, 0}, up{0, 0, 1};

    glm::dvec3 toViewer() const;
    bool operator==(const Axes &) const = default;
};

/// Image axes in radiological convention: axial seen from the feet (patient right at image left,
/// anterior up), coronal from the front, sagittal from the left (anterior at image left).
Axes standardAxes(Orientation orientation);

/// The normal that a plane is scrolled along; superior, posterior or left for standard axes.
glm::dvec3 scrollAxis(const Axes &axes, Orientation orientation);

/// The axes of the three planes, in the order of `Orientation`.
class PlaneAxes {
public:
    PlaneAxes();
    /// *Throws* Error{usage} unless right and up of each are at right angles and of length 1, and
    /// the three planes at right angles to each other.
    explicit PlaneAxes(const std::array<Axes, 3> &axes);

    const Axes &of(Orientation orientation) const { return m_axes[std::size_t(orientation)]; }
    glm::dvec3 scrollAxis(Orientation orientation) const;
    bool areStandard() const { return *this == PlaneAxes(); }
    /// Turns the two others about the normal of this one, whose picture stays as it is. *Units*:
    /// rad, counterclockwise as that picture is seen.
    PlaneAxes turned(Orientation about, double angleRad) const;
    /// Turned together so that the plane nearest to it has this normal.
    PlaneAxes facing(const Axes &wanted) const;
    /// The planes of a scan: the one nearest to its slices shows them as they were taken, row on
    /// row, the others are at right angles to it.
    static PlaneAxes along(const volume::Lattice &lattice);

    bool operator==(const PlaneAxes &) const = default;

private:
    std::array<Axes, 3> m_axes;
};

/// A rectangle of pixels in the patient. Pixel (row r, column c) is centred at
/// center + (c - (width-1)/2) pixel right + ((height-1)/2 - r) pixel up.
struct Plane {
    volume::PatientPoint center;
    Axes axes;
    double pixelMm = 1.0;
    int width = 1, height = 1;

    volume::PatientPoint at(double column, double row) const;
    /// Column and row of the foot of a point; the distance from the plane is lost.
    glm::dvec2 pixel(volume::PatientPoint point) const;
};

/// Nearest and farthest position of the lattice along a normal, mm, and the step between slices
/// there: the smallest distance that reaches a new sample. Slices lie at whole steps from `lowMm`
/// where a normal is that of a side of the lattice's cells.
struct ScrollRange {
    double lowMm = 0.0, highMm = 0.0, stepMm = 1.0;
    bool hasSlices = false;

    /// The position that many steps on, on a slice if there are any, within the range.
    double moved(double positionMm, int steps) const;
};
ScrollRange scrollRange(const volume::Lattice &lattice, const glm::dvec3 &normal);

} // namespace pellucid::mpr
