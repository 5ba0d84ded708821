// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/transforms/strip_transform.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace pellucid::fourier {

namespace {

// Large radices make fewer passes over the data. 16 becomes 4 x 4 instead of 8 x 2, because a radix
// of 4 needs no multiplications inside.
std::vector<int> radices(int length) {
    std::vector<int> result;
    for (const int odd : {9, 7, 5, 3})
        for (; length % odd == 0; length /= odd)
            result.push_back(odd);
    int twos = 0;
    for (; length % 2 == 0; length /= 2)
        ++twos;
    assert(length == 1);
    for (; twos >= 5 || twos == 3; twos -= 3)
        result.push_back(8);
    for (; twos >= 2; twos -= 2)
        result.push_back(4);
    if (twos == 1)
        result.push_back(2);
    return result;
}

} // namespace

StripTransform::StripTransform(int length) : m_length(length) {
    int remaining = length, stride = 1;
    for (const int radix : radices(length)) {
        const int groups = remaining / radix;
        m_stages.push_back({radix, groups, stride, m_twiddles.size()});
        for (int p = 0; p < groups; ++p)
            for (int j = 1; j < radix; ++j) {
                const double angle = 2.0 * std::numbers::pi * p * j / remaining;
                m_twiddles.push_back(float(std::cos(angle)));
                m_twiddles.push_back(float(std::sin(angle)));
            }
        remaining = groups;
        stride *= radix;
    }
}

} // namespace pellucid::fourier
