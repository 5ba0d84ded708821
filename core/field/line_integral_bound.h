// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/volume/lattice.h"

namespace pellucid::field {

/// The maxima of a field without negative samples, for bounding integrals along lines that run
/// mainly along one axis d of its lattice. Each layer across d is cut into squares of a few samples
/// a side.
struct LayerMaxima {
    int samples = 0;           ///< number of layers along d
    int columns = 0, rows = 0; ///< number of squares along the axes d + 1 and d + 2 (mod 3)
    /// The largest sample of each square. *Shape*: [sample along d][row][column].
    std::vector<float> values;

    float &at(int sample, int row, int column) {
        return values[(std::size_t(sample) * std::size_t(rows) + std::size_t(row)) *
                          std::size_t(columns) +
                      std::size_t(column)];
    }
};

/// An upper bound on the integral of the field along any line. *Shape*: one entry of `layers` for
/// each axis d; squares are `side` samples wide. *Units*: the field times mm.
double largestLineIntegral(const std::array<LayerMaxima, 3> &layers, int side,
                           const volume::Lattice &lattice);

} // namespace pellucid::field
