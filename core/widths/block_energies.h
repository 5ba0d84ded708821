// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/task/progress.h"

namespace pellucid::widths {

/// The mean energy of each block of cells of a spectrum: where its slices are bright, and where
/// they are dark.
class BlockEnergies {
public:
    /// *Throws* Cancelled, Error{outOfMemory}.
    explicit BlockEnergies(const fourier::Spectrum &spectrum, const task::Progress &progress = {});

    /// The points that represent a tile. *Units*: cells, from the tile's first frequency.
    static constexpr int pointCount = 16;
    struct Points {
        alignas(64) std::array<std::array<float, pointCount>, 3> cells;
    };
    /// The mean energy of the blocks at the points of a tile; periodic. *Units*: `first`, the
    /// tile's first frequency, in cells by axis; the result is the spectrum squared.
    float mean(const std::array<double, 3> &first, const Points &points) const;
    /// The size of the periodic grid, in cells.
    const volume::GridSize &padded() const { return m_padded; }

    /// The data for the vector code. *Units*: cells.
    struct Table {
        int step;                       ///< of a block along x; `side` along y and z
        int columns, rows, planes;      ///< of blocks
        std::array<float, 3> firstCell; ///< of the first block, by axis
        std::array<float, 3> padded;
        std::vector<float> energies; ///< *Shape*: [plane][row][column]
    };
    static constexpr int side = fourier::CellLayout::planesTogether;

private:
    volume::GridSize m_padded;
    Table m_table;
};

} // namespace pellucid::widths
