// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mpr/plane.h"

namespace pellucid::mpr {

/// A box of a lattice, in voxel coordinates: faces may lie between samples.
struct LatticeBox {
    glm::dvec3 low{0.0}, high{0.0};
};

/// Where a face of a box cuts a plane. *Units*: pixels of the plane, column and row.
struct BoxEdge {
    glm::dvec2 from{0.0}, to{0.0};
    /// Of the face; -1: the border of the picture.
    int axis = -1;
    bool isHigh = false;
};

/// The outline of what a plane cuts out of a box, within the picture and two pixels
/// around it, all the way round once; empty where
/// the plane misses the box.
std::vector<BoxEdge> boxOutline(const volume::Lattice &lattice, const LatticeBox &box,
                                const Plane &plane);

} // namespace pellucid::mpr
