// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/transforms/padded_size.h"

#include <algorithm>
#include <cmath>

namespace pellucid::fourier {

namespace {

// Twice the halo of a spectrum, so that periodic copies do not overlap.
constexpr int smallestPaddedSize = 16;

bool smooth(int n) {
    for (const int prime : {2, 3, 5, 7})
        while (n % prime == 0)
            n /= prime;
    return n == 1;
}

} // namespace

int smoothEvenSize(int atLeast) {
    int n = std::max(2, atLeast + atLeast % 2);
    while (!smooth(n))
        n += 2;
    return n;
}

int paddedSize(int samples, double padding) {
    // Without this margin a product such as 1.5 * 256 could be rounded up to the next size.
    return smoothEvenSize(std::max(smallestPaddedSize, int(std::ceil(padding * samples - 1e-9))));
}

} // namespace pellucid::fourier
