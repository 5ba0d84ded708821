// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "core/volume/lattice.h"

namespace pellucid::volume {

/// The share of each sample that belongs to a region: 0 to 255 for none to all of it, and 0 outside
/// a box.
struct Coverage {
    static constexpr int whole = 255;

    VoxelBox box;                     ///< in the volume's lattice; of no samples: an empty region
    std::vector<std::uint8_t> shares; ///< of the samples in the box, columns fastest

    bool isEmpty() const { return shares.empty(); }
    std::uint8_t at(VoxelIndex n) const {
        return box.contains(n) ? shares[offsetOf(n)] : std::uint8_t(0);
    }
    /// The shares of all samples together. *Units*: samples.
    double total() const { return std::accumulate(shares.begin(), shares.end(), 0.0) / whole; }
    /// *Requires*: the sample is in the box.
    std::size_t offsetOf(VoxelIndex n) const {
        return box.size().offsetOf(n.i - box.lo.i, n.j - box.lo.j, n.k - box.lo.k);
    }
    bool operator==(const Coverage &) const = default;
};

} // namespace pellucid::volume
