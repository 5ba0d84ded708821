// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/plan/folded_tails.h"

namespace pellucid::plan {

/// The frequency grid of one image: columns x rows frequencies, 1/(columns pixel) apart, so that
/// the periodic image they make holds the whole projection beside the asked-for part.
struct SliceGrid {
    int columns = 2, rows = 2;
    bool operator==(const SliceGrid &) const = default;
};

/// What a slice grid has to hold, and how much may fold back into the image.
struct FieldOfView {
    /// Where each of the fields is that the slice is summed from: what lies beyond its radius is
    /// zero. At least one.
    std::vector<std::shared_ptr<const EnergySpread>> spreads;
    /// What the tails of the roll-off may leave when they fold back, relative L2.
    double aliasingLimit = 3e-4;
};

/// What the frames of a camera take beside the spectrum: the lines between the two transforms, and
/// the image.
std::size_t frameBytes(const SliceGrid &grid, const scene::Camera &camera);

/// That of any field within a box.
FieldOfView fieldOfViewOf(const volume::Lattice &lattice, const volume::VoxelBox &box);

/// The smallest smooth slice grid for a camera that no sample of any projection with its footprint
/// along an axis, seen from any direction, wraps into, and whose folded tails are as asked for;
/// where that takes more than three times the cells along an axis, and 1024, those. *Throws*
/// Error{outOfMemory} for more than 65536 frequencies a side.
SliceGrid sliceGrid(const scene::Camera &camera, const FieldOfView &fieldOfView,
                    const volume::Lattice &lattice, const scene::ImageDefinition &image);

} // namespace pellucid::plan
