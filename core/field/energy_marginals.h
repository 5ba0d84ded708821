// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "core/field/blocks.h"
#include "core/volume/field.h"

namespace pellucid::field {

/// How a field's energy f^2 is distributed around the centre, and how concentrated it is.
struct EnergySpread {
    /// Shares of the energy by distance from the centre of the lattice, along 13 directions: the
    /// edges, face diagonals and body diagonals of a cube in patient space. Entry n holds the
    /// distances from n to n + 1 times `distanceStepMm`.
    std::vector<std::vector<double>> byDistance;
    double distanceStepMm = 1.0;
    double shortestStepMm = 1.0, longestStepMm = 1.0; ///< of the lattice
    /// The share of a projection's energy near the highest frequencies of the lattice. The energy
    /// of that part g is at most a sixteenth of that of the second differences along the three
    /// axes, which weights a frequency f by sum_d sin^4(pi f_d). In a field without negative
    /// samples it is an upper bound for any view: |P g|^2 <= depth |g|^2, and `leastProjection`
    /// bounds |P f|^2. In others it is the share of the field's energy, of which a projection has
    /// less on average.
    double roughestView = 1.0;
    /// Distance from the centre of the lattice to the farthest nonzero sample, mm.
    double radiusMm = 0.0;
    /// An upper bound on the mean area of the field's shadow over all directions, mm^2: a quarter
    /// of the surface of its box, or of the enclosing sphere if that is smaller.
    double shadowMm2 = 0.0;
    /// The least energy of any projection of a field without negative samples, relative to the
    /// square of its mass, in 1/mm^2: the larger of the bound m(R)^2 / (pi R^2), where m(R) is the
    /// share of the mass in any ball of radius R, and of the least that a search finds. 0
    /// for a field with negative samples, which may cancel positive ones in some view.
    double leastProjection = 0.0;
    /// For a field without negative samples: in any view, a part's share of the projection's energy
    /// is at most this many times its share of the mass. With f_a the part, <P f_a, P f> <= max(P
    /// f) * mass_a; `largestLineIntegral` bounds max(P f), and `leastProjection` |P f|^2. Infinite
    /// for a field with negative samples.
    double peakedness = std::numeric_limits<double>::infinity();
};

/// The spread of white noise that fills a box evenly.
EnergySpread evenSpread(const volume::Lattice &lattice, const volume::VoxelBox &box);

/// The statistics of a field from which the planner predicts the error of its images.
struct EnergyMarginals {
    /// Shares of the energy along each axis of the box; each axis sums to 1. *Shape*: one entry per
    /// sample of the box.
    std::array<std::vector<double>, 3> axis;
    std::vector<Block> blocks; ///< all blocks that are not empty
    /// The integrals of f and of f^2, mm^3.
    double massMm3 = 0.0, energyMm3 = 0.0;
    std::shared_ptr<const EnergySpread> spread;
};

/// The statistics of a field that is zero outside this box.
EnergyMarginals energyMarginals(const volume::Field &field, const volume::VoxelBox &box);

} // namespace pellucid::field
