// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/segment/stored_masks.h"

namespace pellucid::segment {

/// Reads the pixels of stored masks.
class MaskPixels {
public:
    explicit MaskPixels(const StoredMasks &masks) : m_masks(masks) {}

    /// Calls f(column, segment, share) for each pixel of a row that belongs to a segment.
    template <class F> void forEachInRow(std::size_t plane, int row, const F &f) const {
        const std::size_t first = offsetOf(plane, row);
        const int own = m_masks.planes[plane].segment;
        if (m_masks.kind != StoredMasks::Pixels::bits) {
            for (int c = 0; c < m_masks.columns; ++c) {
                const std::uint16_t value = word(first + std::size_t(c));
                if (value == 0)
                    continue;
                if (m_masks.kind == StoredMasks::Pixels::fractions)
                    f(c, own, share(value));
                else if (const int segment = m_masks.segmentOfLabel[value]; segment >= 0)
                    f(c, segment, volume::Coverage::whole);
            }
            return;
        }
        for (std::size_t bit = first, end = first + std::size_t(m_masks.columns); bit < end;) {
            std::uint64_t bits = 0; // from `bit` on
            std::memcpy(&bits, m_masks.pixels.data() + bit / 8,
                        std::min<std::size_t>(8, m_masks.pixels.size() - bit / 8));
            bits >>= bit % 8;
            const std::size_t count = std::min<std::size_t>(64 - bit % 8, end - bit);
            if (count < 64)
                bits &= (std::uint64_t(1) << count) - 1;
            for (; bits != 0; bits &= bits - 1)
                f(int(bit - first) + std::countr_zero(bits), own, volume::Coverage::whole);
            bit += count;
        }
    }

    /// The share of a pixel that belongs to a segment, 0 to 255; 0 beyond the plane.
    int at(std::size_t plane, int column, int row, int segment) const {
        if (column < 0 || row < 0 || column >= m_masks.columns || row >= m_masks.rows)
            return 0;
        const std::size_t n = offsetOf(plane, row) + std::size_t(column);
        switch (m_masks.kind) {
        case StoredMasks::Pixels::bits:
            return (std::to_integer<int>(m_masks.pixels[n / 8]) >> (n % 8) & 1) *
                   volume::Coverage::whole;
        case StoredMasks::Pixels::fractions:
            return share(word(n));
        case StoredMasks::Pixels::labels:
            return m_masks.segmentOfLabel[word(n)] == segment ? volume::Coverage::whole : 0;
        }
        return 0;
    }

private:
    std::size_t offsetOf(std::size_t plane, int row) const {
        return (plane * std::size_t(m_masks.rows) + std::size_t(row)) *
               std::size_t(m_masks.columns);
    }
    std::uint16_t word(std::size_t n) const {
        std::uint16_t value = 0;
        std::memcpy(&value, m_masks.pixels.data() + n * sizeof(value), sizeof(value));
        return value;
    }
    int share(std::uint16_t fraction) const {
        const int most = m_masks.largestFraction;
        return std::min((2 * volume::Coverage::whole * int(fraction) + most) / (2 * most),
                        volume::Coverage::whole);
    }

    const StoredMasks &m_masks;
};

} // namespace pellucid::segment
