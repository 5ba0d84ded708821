// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/fourier/transforms/padded_size.h"

namespace pellucid {

namespace {

bool smooth(int n) {
    for (const int p : {2, 3, 5, 7})
        while (n % p == 0)
            n /= p;
    return n == 1;
}

TEST(PaddedSize, IsSmoothEvenAndLargeEnough) {
    for (int n = 1; n < 1200; ++n) {
        const int padded = fourier::paddedSize(n, 1.5);
        EXPECT_TRUE(smooth(padded) && padded % 2 == 0 && padded >= 1.5 * n && padded >= 16) << n;
    }
}

TEST(PaddedSize, TakesExactMultiplesAsTheyAre) {
    EXPECT_EQ(fourier::paddedSize(256, 1.5), 384);
    EXPECT_EQ(fourier::paddedSize(512, 1.5), 768);
    EXPECT_EQ(fourier::smoothEvenSize(724), 750); // 2 * 3 * 5^3
}

} // namespace
} // namespace pellucid
