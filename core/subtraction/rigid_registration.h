// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::subtraction {

/// A rotation about a centre and a shift, in patient space: x -> centre + rotation (x - centre) +
/// shift. *Units*: mm.
struct RigidTransform {
    glm::dmat3 rotation{1.0};
    glm::dvec3 centreMm{0.0}, shiftMm{0.0};

    glm::dvec3 operator()(glm::dvec3 pointMm) const {
        return centreMm + rotation * (pointMm - centreMm) + shiftMm;
    }
    /// The angle of the rotation. *Units*: rad.
    double angleRad() const;
    bool isIdentity() const { return *this == RigidTransform(); }
    bool operator==(const RigidTransform &) const = default;
};

/// The alignment of two volumes.
struct Registration {
    RigidTransform toMoving; ///< from points of the fixed volume to those of the moving one
    /// The root mean square of the differences where both volumes are, before and after. *Units*:
    /// those of the values. For two modalities, whose values differ, they mean nothing.
    double residualBefore = 0.0, residualAfter = 0.0;
};

/// Aligns two volumes of one patient by rotation and shift: mutual information (Mattes), first of
/// coarse versions, then of finer ones, to a tenth of a voxel for volumes that differ only by that.
/// Works for tilted volumes, too: they are compared on a grid of cubes. *Throws* Error{unusable} if
/// they do not overlap, Error{internal} if ITK fails, Error{outOfMemory}, Cancelled. *Source*:
/// Mattes et al. 2003; ITK 5.
Registration registerRigidly(const volume::Volume &fixed, const volume::Volume &moving,
                             const task::Progress &progress = {});

} // namespace pellucid::subtraction
