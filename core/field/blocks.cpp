// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/blocks.h"

#include <algorithm>

namespace pellucid::field {

std::vector<BlockRange> blockRanges(int samples) {
    constexpr int most = 20;
    const int count = std::min(samples, most);
    std::vector<BlockRange> ranges;
    for (int n = 0; n < count; ++n)
        ranges.push_back({int(std::int64_t(n) * samples / count),
                          int(std::int64_t(n + 1) * samples / count) - 1});
    return ranges;
}

} // namespace pellucid::field
