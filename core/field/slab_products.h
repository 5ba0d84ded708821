// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/volume/field.h"

namespace pellucid::field {

/// The correlation matrix C of a field's slabs across an axis. Entry (a, b) is a sum over all lines
/// along the axis: the line's integral in slab a times its integral in slab b. If each slab has a
/// weight w, the projection of the weighted field along the axis has the energy w^T C w. This gives
/// the energy of an error that depends on depth, whether or not its slabs add up in phase.
struct SlabProducts {
    /// Slab n starts at sample n * samples / slabs.
    int samples = 1, slabs = 1;
    /// C, scaled so that the plain projection has energy 1. *Shape*: slabs x slabs, symmetric.
    std::vector<double> products;

    /// w^T C w, the energy of the projection with these weights.
    double energy(std::span<const double> weights) const;
};

/// The products of white noise with zero mean: no correlation between slabs. *Shape*: `energy` has
/// one entry per sample along the axis.
SlabProducts evenSlabProducts(std::span<const double> energy);

/// The products of a field along each axis of a box.
std::array<SlabProducts, 3> slabProducts(const volume::Field &field, const volume::VoxelBox &box);

} // namespace pellucid::field
