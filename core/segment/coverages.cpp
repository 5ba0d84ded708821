// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/coverages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace pellucid::segment {

namespace {

using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::VoxelBox;

// Samples of a box as floats, filtered in place.
class Samples {
public:
    Samples(const Coverage &region, const VoxelBox &box)
        : m_box(box), m_size(box.size()), m_values(m_size.count()) {
        tbb::parallel_for(0, m_size.k, [&](int k) {
            for (int j = 0; j < m_size.j; ++j)
                for (int i = 0; i < m_size.i; ++i)
                    m_values[m_size.offsetOf(i, j, k)] =
                        float(region.at({box.lo.i + i, box.lo.j + j, box.lo.k + k}));
        });
    }

    // Convolves with (a, 1 - 2a, a) along an axis: its variance is 2a. Beyond the ends the
    // outermost sample is repeated.
    void blur(int axis, float a, const task::Progress &progress) {
        const int length = m_size[axis];
        const std::size_t step = axis == 0   ? 1
                                 : axis == 1 ? m_size.offsetOf(0, 1, 0)
                                             : m_size.offsetOf(0, 0, 1);
        const int along = axis == 0 ? m_size.j : m_size.i, across = axis == 2 ? m_size.j : m_size.k;
        tbb::parallel_for(0, across, [&](int v) {
            progress.check();
            for (int u = 0; u < along; ++u) {
                float *const line = m_values.data() + (axis == 0   ? m_size.offsetOf(0, u, v)
                                                       : axis == 1 ? m_size.offsetOf(u, 0, v)
                                                                   : m_size.offsetOf(u, v, 0));
                float before = line[0];
                for (int n = 0; n < length; ++n) {
                    const float here = line[std::size_t(n) * step];
                    const float after = n + 1 < length ? line[std::size_t(n + 1) * step] : here;
                    line[std::size_t(n) * step] = here + a * (before - 2.0F * here + after);
                    before = here;
                }
            }
        });
    }

    Coverage rounded() const {
        Coverage result{m_box, std::vector<std::uint8_t>(m_values.size())};
        std::transform(m_values.begin(), m_values.end(), result.shares.begin(),
                       [](float v) { return std::uint8_t(std::lround(v)); });
        return result;
    }

private:
    VoxelBox m_box;
    GridSize m_size;
    std::vector<float> m_values;
};

} // namespace

Coverage softened(const Coverage &region, const GridSize &size, double sigma,
                  const task::Progress &progress) {
    if (region.isEmpty() || sigma <= 0.0)
        return region;
    // A pass with the weights 1/4, 1/2, 1/4 has the variance 1/2; no weight may be larger, because
    // the highest frequency would change its sign.
    const int passes = std::max(1, int(std::ceil(2.0 * sigma * sigma - 1e-9)));
    const auto a = float(sigma * sigma / (2.0 * passes));
    const VoxelBox &box = region.box;
    const VoxelBox grown{{std::max(box.lo.i - passes, 0), std::max(box.lo.j - passes, 0),
                          std::max(box.lo.k - passes, 0)},
                         {std::min(box.hi.i + passes, size.i), std::min(box.hi.j + passes, size.j),
                          std::min(box.hi.k + passes, size.k)}};
    Samples samples(region, grown);
    for (int pass = 0; pass < passes; ++pass)
        for (int axis = 0; axis < 3; ++axis)
            samples.blur(axis, a, progress);
    return samples.rounded();
}

Coverage coarsened(const Coverage &region, const Lattice &from, const Lattice &to,
                   const task::Progress &progress) {
    if (region.isEmpty())
        return region;
    const GridSize size = to.size(), finer = from.size();
    // Both lattices have the same axes: each coordinate has its own cell.
    const auto cellsAlong = [&](int axis) {
        std::vector<int> cells;
        for (int n = 0; n < finer[axis]; ++n) {
            glm::dvec3 v(0.0);
            v[axis] = n;
            const double at = to.voxel(from.patient(volume::VoxelPoint{v})).v[axis];
            cells.push_back(std::clamp(int(std::floor(at + 0.5)), 0, size[axis] - 1));
        }
        return cells;
    };
    const std::array<std::vector<int>, 3> cells{cellsAlong(0), cellsAlong(1), cellsAlong(2)};
    // The number of samples that a cell holds: those at the border may hold fewer.
    std::array<std::vector<int>, 3> counts;
    for (int axis = 0; axis < 3; ++axis) {
        counts[std::size_t(axis)].assign(std::size_t(size[axis]), 0);
        for (const int cell : cells[std::size_t(axis)])
            ++counts[std::size_t(axis)][std::size_t(cell)];
    }
    const VoxelBox &box = region.box;
    const auto cellAt = [&](int i, int j, int k) {
        return volume::VoxelIndex{cells[0][std::size_t(i)], cells[1][std::size_t(j)],
                                  cells[2][std::size_t(k)]};
    };
    const volume::VoxelIndex low = cellAt(box.lo.i, box.lo.j, box.lo.k),
                             last = cellAt(box.hi.i - 1, box.hi.j - 1, box.hi.k - 1);
    Coverage result{{low, {last.i + 1, last.j + 1, last.k + 1}}, {}};
    const GridSize within = result.box.size();
    std::vector<std::uint32_t> sums(within.count());
    for (int k = box.lo.k; k < box.hi.k; ++k) {
        progress.check();
        for (int j = box.lo.j; j < box.hi.j; ++j) {
            const volume::VoxelIndex first = cellAt(box.lo.i, j, k);
            const std::uint8_t *const row =
                region.shares.data() + region.offsetOf({box.lo.i, j, k});
            std::uint32_t *const to0 =
                sums.data() + within.offsetOf(0, first.j - low.j, first.k - low.k);
            for (int i = box.lo.i; i < box.hi.i; ++i)
                to0[cells[0][std::size_t(i)] - low.i] += row[i - box.lo.i];
        }
    }
    result.shares.resize(sums.size());
    for (int k = 0; k < within.k; ++k)
        for (int j = 0; j < within.j; ++j)
            for (int i = 0; i < within.i; ++i) {
                const double held = double(counts[0][std::size_t(low.i + i)]) *
                                    counts[1][std::size_t(low.j + j)] *
                                    counts[2][std::size_t(low.k + k)];
                const std::size_t n = within.offsetOf(i, j, k);
                result.shares[n] = std::uint8_t(std::lround(sums[n] / held));
            }
    return result;
}

} // namespace pellucid::segment
