// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>

#include "core/volume/lattice.h"

namespace pellucid::mpr {

/// The three orthogonal planes of the patient.
enum class Orientation { axial, coronal, sagittal };

/// A rectangle of pixels in the patient. Pixel (row r, column c) is centred at
/// center + (c - (width-1)/2) pixel right + ((height-1)/2 - r) pixel up.
struct Plane {
    volume::PatientPoint center;
    glm::dvec3 right{1, 0, 0}, up{0, 0, 1};
    double pixelMm = 1.0;
    int width = 1, height = 1;

    volume::PatientPoint at(double column, double row) const;
    /// Column and row of the foot of a point; the distance from the plane is lost.
    glm::dvec2 pixel(volume::PatientPoint point) const;
    glm::dvec3 toViewer() const;
    bool operator==(const Plane &other) const;
};

/// Image axes in radiological convention: axial seen from the feet (patient right at image left,
/// anterior up), coronal from the front, sagittal from the left (anterior at image left).
void setAxes(Plane &plane, Orientation orientation);

/// Nearest and farthest position of the lattice along a plane's normal direction, mm, and the step
/// between slices there: the smallest distance that reaches a new sample.
struct ScrollRange {
    double lowMm = 0.0, highMm = 0.0, stepMm = 1.0;
};
ScrollRange scrollRange(const volume::Lattice &lattice, Orientation orientation);

/// The axis of LPS that an orientation scrolls along, pointing superior, posterior or left.
glm::dvec3 scrollAxis(Orientation orientation);

} // namespace pellucid::mpr
