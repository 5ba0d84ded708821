// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/widths/width_map.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace pellucid::widths {

// The Nyquist row is on the edge of the band, where the roll-off is 0.
SliceTiles::SliceTiles(const SlicePlane &plane)
    : strips((plane.columns / 2 + columns - 1) / columns),
      perSide((plane.rows / 2 + rows - 1) / rows) {
    for (int strip = 0; strip < strips; ++strip) {
        const double u = 2.0 * columns * strip / plane.columns;
        const double last = std::sqrt(std::max(0.0, 1.0 - u * u)) * plane.rows / 2.0;
        sides.push_back(std::min(perSide, int(std::ceil(last / rows))));
    }
}

WidthMap::Shares WidthMap::shares(const SlicePlane &plane) const {
    Shares shares{};
    const SliceTiles all(plane);
    double count = 0.0;
    all.forEach([&](int strip, int tile) {
        shares[widths[all.at(strip, tile)]] += 1.0;
        count += 1.0;
    });
    for (double &share : shares)
        share /= count;
    return shares;
}

void inOrder(int count, const std::function<void(int)> &work) {
    for (int n = 0; n < count; ++n)
        work(n);
}

void onAllThreads(int count, const std::function<void(int)> &work) {
    tbb::parallel_for(0, count, work);
}

} // namespace pellucid::widths
