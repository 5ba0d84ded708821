// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/field/blocks.h"
#include "core/volume/lattice.h"

namespace pellucid::field {

// A lower bound and an estimate of the least energy of any projection of a field without negative
// samples, relative to the square of its mass; the larger of them counts. *Units*: 1/mm^2.

/// The mass of a field in balls about its centre of mass. The projection of a ball lies in a disc,
/// so the projection's energy is at least m(R)^2/(pi R^2), where m(R) is the share of the mass in a
/// ball of radius R.
class MassInBalls {
public:
    /// Adds a block, with its share of the mass.
    void add(const glm::dvec3 &middleMm, double share);

    /// The minimum of pi R^2/m(R)^2 over all R: one over the bound. No sample of a block is farther
    /// than `halfMm` from the block's middle.
    double minArea(double halfMm) const;

private:
    struct Block {
        glm::dvec3 middleMm;
        double share;
    };
    std::vector<Block> m_blocks;
    glm::dvec3 m_center{0.0};
};

/// The least energy of coarse projections: of 64 directions all around, and downhill from the four
/// with the least. They are computed from the masses of blocks; spreading each mass over its block
/// lowers the energy. *Shape*: the blocks of a field in a box of the lattice.
double leastProjectionEnergy(std::span<const Block> blocks, const volume::Lattice &lattice,
                             const volume::VoxelBox &box);

} // namespace pellucid::field
