// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/fourier/kernels/kernel.h"

namespace pellucid::widths {

/// The grid of a view's slice: half a plane, columns 0 to columns / 2 and rows on both sides of 0.
struct SlicePlane {
    int columns = 0, rows = 0;                   ///< of the whole grid
    std::array<double, 3> perColumn{}, perRow{}; ///< *Units*: cells of the spectrum, by axis
};

/// The tiles of a slice: a strip has `columns` columns, and its tiles `rows` rows each. *Throws*
/// std::bad_alloc.
struct SliceTiles {
    static constexpr int columns = 16, rows = 16;

    explicit SliceTiles(const SlicePlane &plane);
    int strips;             ///< in half a plane
    int perSide;            ///< tiles of a strip on each side of row 0
    std::vector<int> sides; ///< of them within the band on each side of row 0, by strip

    std::size_t count() const { return std::size_t(strips) * 2 * std::size_t(perSide); }
    /// `tile`: -perSide to perSide - 1; a tile begins at row tile * rows. *Shape*: [strip][tile].
    std::size_t at(int strip, int tile) const {
        return (std::size_t(strip) * 2 + 1) * std::size_t(perSide) + std::size_t(tile);
    }
    /// Calls `visit(strip, tile)` for every tile within the band.
    template <class Visit> void forEach(const Visit &visit) const {
        for (int strip = 0; strip < strips; ++strip)
            for (int tile = -sides[std::size_t(strip)]; tile < sides[std::size_t(strip)]; ++tile)
                visit(strip, tile);
    }
    /// Whether a tile touches frequency 0.
    static bool isCentral(int strip, int tile) { return strip == 0 && (tile == 0 || tile == -1); }
};

/// The width of the kernel that reads each tile of a slice. Width 0 leaves a tile out.
struct WidthMap {
    int strips = 0;                   ///< up to the last one that is read
    int tiles = 0;                    ///< of a strip on each side of row 0
    std::vector<std::uint8_t> widths; ///< *Shape*: as `SliceTiles::at`

    /// Tiles of a strip; the first begins at row -tiles * SliceTiles::rows.
    std::span<const std::uint8_t> strip(int strip) const {
        return std::span(widths).subspan(std::size_t(strip) * 2 * std::size_t(tiles),
                                         2 * std::size_t(tiles));
    }
    /// The share of the tiles within the band that each width reads.
    using Shares = std::array<double, fourier::Kernel::largestWidth + 1>;
    Shares shares(const SlicePlane &plane) const;
};

/// Runs `work(n)` for n = 0..count-1, in any order and on any threads. The work does not throw.
using ForEach = std::function<void(int count, const std::function<void(int)> &work)>;
/// On this thread.
void inOrder(int count, const std::function<void(int)> &work);
/// On the threads of oneTBB.
void onAllThreads(int count, const std::function<void(int)> &work);

} // namespace pellucid::widths
