// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/plane_sum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/render/view_cells.h"
#include "core/volume/lane_sum.h"

namespace pellucid::render {

namespace {

constexpr int largestWidth = fourier::Kernel::largestWidth;

int lo(const volume::VoxelBox &box, int axis) {
    return axis == 0 ? box.lo.i : axis == 1 ? box.lo.j : box.lo.k;
}
int hi(const volume::VoxelBox &box, int axis) {
    return lo(box, axis) + box.size()[axis];
}

// Reads rows of samples that lie across a view, with zeros on both sides.
class PlaneRows {
public:
    PlaneRows(const volume::Field &field, const volume::VoxelBox &box,
              const plan::ShearedGrid &grid)
        : m_field(field), m_box(box), m_along(grid.along), m_count(box.size()[grid.axes[0].axis]),
          m_length(std::size_t((m_count + side - 1) / side * side + 2 * zeros)),
          m_rows(m_along == 0 ? 0 : m_length) {}

    int count() const { return m_count; }
    // Planes that are read together: where they lie across the rows of the lattice, a sample comes
    // with its neighbours.
    int planesPerBlock() const { return m_along == 0 ? most : 1; }

    // Prepares for the rows `first` to `last` of so many planes.
    void load(int plane, int planes, int first, int last) {
        m_plane = plane;
        m_first = first;
        m_planeRows = std::size_t(last - first + 1);
        if (m_along != 0)
            return;
        m_rows.resize(std::max(m_rows.size(), most * m_planeRows * m_length));
        alignas(64) std::array<float, std::size_t(side) * most> samples;
        for (int n = first; n <= last; ++n)
            for (int j = 0; j < m_count; j += side) {
                const auto at = [&](int row) {
                    return volume::VoxelIndex{plane, m_box.lo.j + j + row, n};
                };
                samples.fill(0.0F);
                for (int row = side; row < std::min(2 * side, m_count - j); ++row)
                    fetch(at(row));
                for (int row = 0; row < std::min(side, m_count - j); ++row)
                    m_field.copyRow(at(row), planes, samples.data() + row * most);
                for (int p = 0; p < most; p += side)
                    transposeRows(samples.data() + p, most, loaded(p, n) + j,
                                  m_planeRows * m_length);
            }
    }
    // The first of `count()` samples of row n, so many planes behind the first that was loaded.
    // Valid until the next call.
    const float *row(int plane, int n) {
        if (m_along == 0)
            return loaded(plane, n);
        float *const to = m_rows.data() + zeros;
        m_field.copyRow(m_along == 2 ? volume::VoxelIndex{m_box.lo.i, n, m_plane}
                                     : volume::VoxelIndex{m_box.lo.i, m_plane, n},
                        m_count, to);
        return to;
    }

private:
    static constexpr int zeros = largestWidth + 1; ///< as far as the weights of a row reach
    static constexpr int side = 16, most = 32;     ///< of transpositions; planes of a block

    // Asks for a sample that will be read: those of one column lie too far apart for the processor
    // to foresee.
    void fetch(volume::VoxelIndex n) const {
        m_field.samples().visit([&](auto samples) {
            __builtin_prefetch(samples.data() + m_field.lattice().size().offsetOf(n.i, n.j, n.k));
        });
    }
    float *loaded(int plane, int n) {
        return m_rows.data() +
               (std::size_t(plane) * m_planeRows + std::size_t(n - m_first)) * m_length + zeros;
    }

    const volume::Field &m_field;
    const volume::VoxelBox m_box;
    int m_along, m_count;
    std::size_t m_length;
    std::vector<float> m_rows; ///< the zeros beside each row stay
    int m_plane = 0, m_first = 0;
    std::size_t m_planeRows = 0;
};

} // namespace

SpreadWeights::SpreadWeights(const plan::ShearedAxis &axis, double middle, double plane)
    : parts(std::size_t(axis.cellsPerSample)) {
    const int m = axis.cellsPerSample;
    const double at = m * (-middle - axis.shear * plane - axis.first); // the cell of sample 0
    if (!axis.isSpread) {
        shift = int(std::lround(at));
        parts.front() = {0, 1, {1.0F}};
        return;
    }
    const fourier::Kernel &kernel = plan::spreadKernel();
    const double half = 0.5 * kernel.width();
    shift = int(std::floor(at / m));
    const double rest = at - double(m) * shift;
    for (int r = 0; r < m; ++r) {
        Part &part = parts[std::size_t(r)];
        part.first = int(std::ceil((rest - r - half) / m));
        const int last = int(std::floor((rest - r + half) / m));
        for (int j = part.first; j <= last && part.count < largestWidth; ++j)
            part.weights[std::size_t(part.count++)] = float(kernel.value(m * j + r - rest));
    }
}

int SpreadWeights::firstOf(int lo) const {
    int first = parts.front().first;
    for (const Part &part : parts)
        first = std::min(first, part.first);
    return lo + shift + first;
}

int SpreadWeights::lastOf(int hi) const {
    int last = parts.front().first;
    for (const Part &part : parts)
        last = std::max(last, part.first + part.count - 1);
    return hi - 1 + shift + last;
}

// Adds planes to some rows of cells. It is one thread's.
class PlaneSum::Block {
public:
    explicit Block(const PlaneSum &sum)
        : m_sum(sum), m_grid(sum.m_grid), m_rows(sum.m_field, sum.m_box, sum.m_grid),
          m_kept(std::size_t(slots) * std::size_t(sum.rowFloats())) {}

    // Sums `count` rows of cells from `first` on. *Shape*: `to`: of these rows.
    void run(int first, int count, float *to, const task::Progress &progress) {
        if (m_grid.along == 0 && !m_grid.axes[0].isSpread && !m_grid.axes[1].isSpread)
            return sumRows(first, count, to, progress);
        std::fill_n(to, std::size_t(count) * std::size_t(m_sum.rowFloats()), 0.0F);
        const int lowest = lo(m_sum.m_box, m_grid.along), planes = m_sum.m_box.size()[m_grid.along];
        for (int p = 0; p < planes; p += m_rows.planesPerBlock()) {
            progress.check();
            const int together = std::min(m_rows.planesPerBlock(), planes - p);
            int from = hi(m_sum.m_box, m_grid.axes[1].axis), last = -1;
            for (int n = p; n < p + together; ++n) {
                const auto [low, high] = needed(m_sum.m_weights[1][std::size_t(n)], first, count);
                from = std::min(from, low);
                last = std::max(last, high);
            }
            if (from > last)
                continue;
            m_rows.load(lowest + p, together, from, last);
            for (int n = 0; n < together; ++n)
                addPlane(p + n, n, first, count, to);
        }
    }

private:
    // A spread row is kept in the slot of its number modulo this.
    static constexpr int slots = 8;
    static_assert(slots >= largestWidth);

    // Samples that lie on cells, summed along the rows of the lattice.
    void sumRows(int first, int count, float *to, const task::Progress &progress) const {
        const volume::VoxelBox &box = m_sum.m_box;
        const volume::GridSize size = box.size();
        std::vector<float> buffer(std::size_t(size.i), 0.0F);
        for (int k = first; k < first + count; ++k) {
            progress.check();
            for (int j = 0; j < size.j; ++j) {
                const float *const row = m_sum.m_field.row({box.lo.i, box.lo.j + j, box.lo.k + k},
                                                           size.i, buffer.data());
                *to++ = volume::laneSum(size.i, [&](int i) { return row[i]; });
            }
        }
    }

    // The first and the last row of samples that reach these rows of cells.
    std::pair<int, int> needed(const SpreadWeights &across, int first, int count) const {
        const plan::ShearedAxis &axis = m_grid.axes[1];
        const int m = axis.cellsPerSample;
        return {
            std::max(lo(m_sum.m_box, axis.axis), first / m - across.lastOf(1)),
            std::min(hi(m_sum.m_box, axis.axis) - 1, (first + count - 1) / m - across.firstOf(0))};
    }

    // Adds a plane of the box, so many behind the first that was loaded.
    void addPlane(int plane, int behind, int first, int count, float *to) {
        const SpreadWeights &along = m_sum.m_weights[0][std::size_t(plane)],
                            &across = m_sum.m_weights[1][std::size_t(plane)];
        const plan::ShearedAxis &axis = m_grid.axes[1];
        const int lowest = lo(m_sum.m_box, axis.axis), end = hi(m_sum.m_box, axis.axis);
        const int firstSample = lo(m_sum.m_box, m_grid.axes[0].axis);
        m_from = std::max(0, along.firstOf(firstSample));
        m_count =
            std::min(m_sum.m_segment - 1, along.lastOf(firstSample + m_rows.count())) - m_from + 1;
        m_known.fill(lowest - 1);
        for (int cell = first; cell < first + count; ++cell) {
            const int i = cell / axis.cellsPerSample, r = cell % axis.cellsPerSample;
            const SpreadWeights::Part &part = across.parts[std::size_t(r)];
            WeightedRows sources;
            for (int t = 0; t < part.count; ++t) {
                const int n = i - across.shift - part.first - t;
                if (n >= lowest && n < end)
                    if (const float *const row = spread(along, behind, n))
                        sources.add(row, part.weights[std::size_t(t)]);
            }
            if (sources.count == 0)
                continue;
            float *const cells = to + std::size_t(cell - first) * std::size_t(m_sum.rowFloats());
            for (int s = 0; s < m_grid.axes[0].cellsPerSample; ++s) {
                addSum(sources, m_count, cells + s * m_sum.m_segment + m_from);
                for (int source = 0; source < sources.count; ++source)
                    sources.from[std::size_t(source)] += m_sum.m_segment;
            }
        }
    }

    // A row of samples on the cells where it lands, from the first that it reaches on; null if all
    // are zero.
    const float *spread(const SpreadWeights &along, int behind, int n) {
        const std::size_t slot = std::size_t(n) % slots;
        float *const kept = m_kept.data() + slot * std::size_t(m_sum.rowFloats());
        if (m_known[slot] == n)
            return m_isEmpty[slot] ? nullptr : kept;
        m_known[slot] = n;
        const float *const samples = m_rows.row(behind, n);
        m_isEmpty[slot] = std::all_of(samples, samples + m_rows.count(),
                                      [](float value) { return value == 0.0F; });
        if (m_isEmpty[slot])
            return nullptr;
        const float *const first = samples - lo(m_sum.m_box, m_grid.axes[0].axis); // of the lattice
        for (std::size_t r = 0; r < along.parts.size(); ++r) {
            const SpreadWeights::Part &part = along.parts[r];
            WeightedRows sources;
            for (int t = 0; t < part.count; ++t)
                sources.add(first + m_from - along.shift - part.first - t,
                            part.weights[std::size_t(t)]);
            setToSum(sources, m_count, kept + r * std::size_t(m_sum.m_segment));
        }
        return kept;
    }

    const PlaneSum &m_sum;
    const plan::ShearedGrid &m_grid;
    PlaneRows m_rows;
    std::vector<float> m_kept;
    std::array<int, slots> m_known{};
    std::array<bool, slots> m_isEmpty{};
    int m_from = 0, m_count = 0; ///< of the cells that a plane reaches
};

PlaneSum::PlaneSum(const volume::Field &field, const volume::VoxelBox &box,
                   const plan::ShearedGrid &grid)
    : m_field(field), m_box(box), m_grid(grid),
      m_segment((grid.axes[0].cells + grid.axes[0].cellsPerSample - 1) /
                grid.axes[0].cellsPerSample) {
    const auto middleOf = [&](int axis) { return 0.5 * (field.lattice().size()[axis] - 1); };
    for (int p = lo(box, grid.along); p < hi(box, grid.along); ++p)
        for (std::size_t d = 0; d < 2; ++d)
            m_weights[d].emplace_back(grid.axes[d], middleOf(grid.axes[d].axis),
                                      p - middleOf(grid.along));
}

void PlaneSum::run(float *to, const task::Progress &progress) const {
    // Wide blocks read fewer rows twice, but threads need several each.
    constexpr int fewest = 48, most = 256;
    const int all = m_grid.axes[1].cells,
              rows = std::clamp(all / (4 * tbb::this_task_arena::max_concurrency()), fewest, most);
    tbb::enumerable_thread_specific<Block> blocks([&] { return Block(*this); });
    tbb::parallel_for(0, (all + rows - 1) / rows, [&](int n) {
        const int first = n * rows;
        blocks.local().run(first, std::min(rows, all - first),
                           to + std::size_t(first) * std::size_t(rowFloats()), progress);
    });
}

} // namespace pellucid::render
