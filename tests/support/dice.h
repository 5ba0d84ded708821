// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/volume/coverage.h"
#include "core/volume/volume.h"

namespace pellucid::test {

/// Twice the samples in common over the sum of samples.
inline double dice(const volume::Coverage &a, const volume::Volume &labels, double label) {
    const volume::GridSize n = labels.lattice().size();
    double both = 0.0, sum = 0.0;
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i) {
                const bool isIn = a.at({i, j, k}) != 0, isTrue = labels.value({i, j, k}) == label;
                both += isIn && isTrue;
                sum += int(isIn) + int(isTrue);
            }
    return 2.0 * both / sum;
}

} // namespace pellucid::test
