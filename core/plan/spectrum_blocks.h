// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/spectrum.h"

namespace pellucid::plan {

/// A bound on the mean energy of blocks of cells, see SpectrumEnergies.
struct SpectrumBlocks {
    explicit SpectrumBlocks(const fourier::Spectrum &spectrum);

    int step;                       ///< cells of a block along x; 8 along y and z
    int columns, rows, planes;      ///< of blocks
    std::array<float, 3> firstCell; ///< of the first block, by axis
    std::vector<float> energy;      ///< *Shape*: [plane][row][column]. *Units*: of cells squared
};

/// Measures the blocks of one column and plane.
void measureBlocks(const fourier::Spectrum &spectrum, int column, int plane,
                   SpectrumBlocks &blocks);

/// A plane through frequency 0, cut into parallelograms, each represented by a point.
struct PlaneWalk {
    const SpectrumBlocks *blocks = nullptr;
    std::array<float, 3> padded{}, perU{}, perV{}; ///< cells of the period and per step, by axis
    float stepU = 0.0F, stepV = 0.0F;              ///< *Units*: rings
    int countU = 0, countV = 0;                    ///< steps to the limit
    const float *factors = nullptr; ///< the reconstruction's squared factor, by cycles per sample
    float factorsPerCycle = 0.0F;
    int lastFactor = 0, rings = 0;
};

/// Adds the energies of row `v`, times the area of a point, to the rings; the other half of the
/// plane mirrors it.
void walkRow(const PlaneWalk &walk, int v, float *rings);

} // namespace pellucid::plan
