// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace pellucid::volume {

/// The sum of term(0) .. term(count - 1), added up in eight lanes: compilers turn those into vector
/// code, whereas they may not reorder a single sum.
template <class Term> auto laneSum(int count, const Term &term) {
    using Value = std::remove_cvref_t<decltype(term(0))>;
    constexpr int lanes = 8;
    std::array<Value, lanes> sums{};
    int n = 0;
    for (; n + lanes <= count; n += lanes)
        for (int lane = 0; lane < lanes; ++lane)
            sums[std::size_t(lane)] += term(n + lane);
    Value sum{};
    for (; n < count; ++n)
        sum += term(n);
    for (const Value lane : sums)
        sum += lane;
    return sum;
}

} // namespace pellucid::volume
