// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mpr/plane.h"

namespace pellucid::mpr {

/// A box of a lattice in voxel coordinates; faces may be between samples.
struct LatticeBox {
    glm::dvec3 low{0.0}, high{0.0};
};

/// The intersection of a face of a box with a plane. *Units*: pixels of the plane, column and row.
struct BoxEdge {
    glm::dvec2 from{0.0}, to{0.0};
    /// The axis of the face; -1: the border of the picture.
    int axis = -1;
    bool isHigh = false;
};

/// The closed outline of a box's cross-section with a plane, within the picture and two pixels
/// around it; empty if the plane misses the box.
std::vector<BoxEdge> boxOutline(const volume::Lattice &lattice, const LatticeBox &box,
                                const Plane &plane);

} // namespace pellucid::mpr
