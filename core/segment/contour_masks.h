// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/segment/stored_masks.h"

namespace pellucid::segment {

/// Planes filled from contours; `masks.pixels` refers to `fractions`.
struct FilledContours {
    StoredMasks masks;
    std::vector<std::uint16_t> fractions;
    /// The largest distance of a plane along the lattice's slices from the nearest of them, mm. 0
    /// if all such planes within the volume are on slices.
    double betweenSlicesMm = 0.0;
};

/// Fills closed planar contours: a pixel gets the share of its area that they enclose, computed in
/// 16 lines a pixel. A contour within another of the same plane is a hole. Contours along the
/// lattice's slices are filled on its own columns and rows, and on its samples where a slice is no
/// farther than `sampleTolerance` or the rounding of the contours' coordinates; others on a grid in
/// their plane with the lattice's shortest step. *Shape*: `contours` has at least one, with at
/// least three points each. *Throws* Error{unusable} if a contour is not planar or the planes are
/// not parallel, Error{outOfMemory}, Cancelled.
FilledContours filled(const std::vector<std::span<const glm::dvec3>> &contours,
                      const volume::Lattice &lattice, const task::Progress &progress = {});

} // namespace pellucid::segment
