// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/coverages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

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
    void blur(int axis, float a) {
        const int length = m_size[axis];
        const std::size_t step = axis == 0   ? 1
                                 : axis == 1 ? m_size.offsetOf(0, 1, 0)
                                             : m_size.offsetOf(0, 0, 1);
        const int along = axis == 0 ? m_size.j : m_size.i, across = axis == 2 ? m_size.j : m_size.k;
        tbb::parallel_for(0, across, [&](int v) {
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

Coverage softened(const Coverage &region, const GridSize &size, double sigma) {
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
            samples.blur(axis, a);
    return samples.rounded();
}

Coverage coarsened(const Coverage &region, const Lattice &from, const Lattice &to) {
    if (region.isEmpty())
        return region;
    const GridSize size = to.size();
    const auto cellOf = [&](int i, int j, int k) {
        const glm::dvec3 v =
            glm::floor(to.voxel(from.patient(volume::VoxelIndex{i, j, k})).v + 0.5);
        const glm::dvec3 last(size.i - 1, size.j - 1, size.k - 1);
        const glm::dvec3 inside = glm::clamp(v, glm::dvec3(0.0), last);
        return volume::VoxelIndex{int(inside.x), int(inside.y), int(inside.z)};
    };
    const VoxelBox &box = region.box;
    VoxelBox cells;
    for (int corner = 0; corner < 8; ++corner) {
        const volume::VoxelIndex n = cellOf((corner & 1) != 0 ? box.hi.i - 1 : box.lo.i,
                                            (corner & 2) != 0 ? box.hi.j - 1 : box.lo.j,
                                            (corner & 4) != 0 ? box.hi.k - 1 : box.lo.k);
        cells = united(cells, {n, {n.i + 1, n.j + 1, n.k + 1}});
    }
    const GridSize within = cells.size();
    std::vector<double> sums(within.count());
    for (int k = box.lo.k; k < box.hi.k; ++k)
        for (int j = box.lo.j; j < box.hi.j; ++j)
            for (int i = box.lo.i; i < box.hi.i; ++i)
                if (const std::uint8_t share = region.at({i, j, k}); share != 0) {
                    const volume::VoxelIndex n = cellOf(i, j, k);
                    sums[within.offsetOf(n.i - cells.lo.i, n.j - cells.lo.j, n.k - cells.lo.k)] +=
                        share;
                }
    Coverage result{cells, std::vector<std::uint8_t>(sums.size())};
    const double samplesEach = to.cellVolumeMm3() / from.cellVolumeMm3();
    std::transform(sums.begin(), sums.end(), result.shares.begin(), [&](double sum) {
        return std::uint8_t(std::min(std::lround(sum / samplesEach), long(Coverage::whole)));
    });
    return result;
}

} // namespace pellucid::segment
