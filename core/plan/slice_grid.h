// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/plan/folded_tails.h"

namespace pellucid::plan {

/// The frequency grid of one image: columns x rows frequencies, 1/(columns pixel) apart. Its
/// periodic image holds the whole projection, not just the visible part.
struct SliceGrid {
    int columns = 2, rows = 2;
    bool operator==(const SliceGrid &) const = default;
};

/// What a slice grid has to cover, and how much may fold back into the image.
struct FieldOfView {
    /// The extents of the fields whose spectra are summed: each is zero beyond its radius. At least
    /// one.
    std::vector<std::shared_ptr<const field::EnergySpread>> spreads;
    /// The limit on the roll-off tails that fold back, relative L2.
    double aliasingLimit = 3e-4;
};

/// The memory of a camera's frames besides the spectra: the lines between the two transforms of
/// each image, and the picture, which has three channels if there is more than one image.
std::size_t frameBytes(const SliceGrid &grid, const scene::Camera &camera, int images);

/// The field of view of any field within a box.
FieldOfView fieldOfViewOf(const volume::Lattice &lattice, const volume::VoxelBox &box);

/// The smallest smooth slice grid for a camera such that no sample of the projection, with its
/// footprint, wraps into the image in any view, and the folded tails are within the limit. The
/// tails may raise the size of an axis to at most three times, or to 2048 if that is more. *Throws*
/// Error{outOfMemory} above 65536 frequencies a side.
SliceGrid sliceGrid(const scene::Camera &camera, const FieldOfView &fieldOfView,
                    const volume::Lattice &lattice, const scene::ImageDefinition &image);

} // namespace pellucid::plan
