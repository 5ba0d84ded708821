// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/classify/tissue_class.h"

namespace pellucid::preprocess {

/// Whether a value belongs at least half to a class.
class Belonging {
public:
    explicit Belonging(const classify::TissueClass &tissue) : m_tissue(tissue) {
        if (tissue.softness <= 0.0)
            return;
        m_table.reserve(1 << 16);
        for (int value = lowest; value <= std::numeric_limits<std::int16_t>::max(); ++value)
            m_table.push_back(tissue.membership(value) >= 0.5);
    }

    template <class T> bool operator()(T value) const {
        if (m_table.empty())
            return double(value) >= m_tissue.low && double(value) <= m_tissue.high;
        if constexpr (std::is_same_v<T, std::int16_t>)
            return m_table[std::size_t(int(value) - lowest)] != 0;
        else
            return m_tissue.membership(double(value)) >= 0.5;
    }

private:
    static constexpr int lowest = std::numeric_limits<std::int16_t>::min();
    const classify::TissueClass &m_tissue;
    std::vector<std::uint8_t> m_table; ///< of 16-bit values, if the range has soft ends
};

} // namespace pellucid::preprocess
