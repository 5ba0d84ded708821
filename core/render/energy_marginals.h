// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/volume/volume.h"

namespace pellucid::render {

/// How far out a field's energy f^2 lies, and how it varies.
struct EnergySpread {
    /// Shares of the energy by the distance from the centre of the lattice along 13 directions (the
    /// edges, the diagonals of the faces and of the body of a cube in patient space). Entry n is
    /// for distances from n to n + 1 times `distanceStepMm`.
    std::vector<std::vector<double>> byDistance;
    double distanceStepMm = 1.0;
    /// The sum of the squared shares of blocks of samples: 1 for a point, one over their number for
    /// an even field.
    double concentration = 1.0;
    /// How far from the centre of the lattice a sample is not zero, mm.
    double radiusMm = 0.0;
    /// The mean area of its shadow over all directions, mm^2, at most: a quarter of the surface of
    /// its box, or of the sphere it lies in.
    double shadowMm2 = 0.0;
    /// Of a field without negative samples: the share of a projection's energy that a part of the
    /// field has is at most this many times its share of the mass, seen from anywhere. With f_a the
    /// part, <P f_a, P f> <= max(P f) * mass_a, where max(P f) is `largestLineIntegral`; and
    /// |P f|^2 is at least m(R)^2 / (pi R^2) with m(R) the mass in any ball of radius R, or close
    /// to the least of what coarse projections from all around have. Infinite where negative
    /// samples may cancel others in some view.
    double peakedness = std::numeric_limits<double>::infinity();
};

/// The spread of noise that fills a box.
EnergySpread evenSpread(const volume::Lattice &lattice, const volume::VoxelBox &box);

/// The samples of an axis that a block reaches over, both included.
struct BlockRange {
    int first = 0, last = 0;
};

/// Where axes of a box are cut into blocks.
std::vector<BlockRange> blockRanges(int samples);

/// What a part of a field has of the whole.
struct FieldBlock {
    std::array<std::uint8_t, 3> at{}; ///< along each axis, see `blockRanges`
    float energy = 0.0F, mass = 0.0F; ///< shares
};

/// All that the error of a field's images is predicted from.
struct EnergyMarginals {
    /// Along each axis of its box; sums to 1. *Shape*: one entry per sample of the box.
    std::array<std::vector<double>, 3> axis;
    std::vector<FieldBlock> blocks; ///< those that are not empty
    /// The integrals of f and of f^2, mm^3.
    double massMm3 = 0.0, energyMm3 = 0.0;
    std::shared_ptr<const EnergySpread> spread;
};

EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box);

/// The products of a field's slabs across an axis: entry (a, b) is the sum over all lines along the
/// axis of what they hold in slab a times what they hold in slab b. With a weight w by slab, the
/// projection along the axis of the weighted field has the energy w^T C w: what an error that
/// depends on the depth leaves of it, in phase or not.
struct SlabProducts {
    /// Slab n holds the samples from n * samples / slabs on.
    int samples = 1, slabs = 1;
    std::vector<double> products; ///< slabs x slabs, symmetric; the plain projection has energy 1

    /// w^T C w.
    double energy(std::span<const double> weights) const;
};

/// Of noise without a mean, whose slabs have nothing in common. *Shape*: the energy of each sample.
SlabProducts evenSlabProducts(std::span<const double> energy);

/// Of each axis of a box.
std::array<SlabProducts, 3> slabProducts(const volume::Volume &field, const volume::VoxelBox &box);

} // namespace pellucid::render
