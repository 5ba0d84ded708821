// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/volume/field.h"

namespace pellucid::field {

/// A row of samples and its four neighbours: above and below in the same plane, before and after in
/// the adjacent planes.
struct RowAndNeighbours {
    const float *here, *above, *below, *before, *after;
};

/// Reads the rows of a box one below the other. Samples outside the box are zero.
class RowReader {
public:
    RowReader(const volume::Field &field, const volume::VoxelBox &box)
        : m_field(field), m_box(box), m_none(std::size_t(box.size().i)) {
        m_buffers.fill(m_none);
    }
    /// Prepares to read row j of plane k of the box, and those below it.
    void start(int j, int k) {
        m_here = at(j - 1, k, (j + 2) % 3);
        m_below = at(j, k, j % 3);
    }
    /// Row j of plane k, which follows the last one. It is valid until the next call.
    RowAndNeighbours next(int j, int k) {
        const float *const above = std::exchange(m_here, m_below);
        m_below = at(j + 1, k, (j + 1) % 3);
        return {m_here, above, m_below, at(j, k - 1, 3), at(j, k + 1, 4)};
    }

private:
    const float *at(int j, int k, int buffer) {
        const volume::GridSize size = m_box.size();
        return j >= 0 && j < size.j && k >= 0 && k < size.k
                   ? m_field.row({m_box.lo.i, j + m_box.lo.j, k + m_box.lo.k}, size.i,
                                 m_buffers[std::size_t(buffer)].data())
                   : m_none.data();
    }

    const volume::Field &m_field;
    const volume::VoxelBox m_box;
    std::vector<float> m_none;
    std::array<std::vector<float>, 5> m_buffers; ///< three rows of the plane; before and after
    const float *m_here = nullptr, *m_below = nullptr;
};

} // namespace pellucid::field
