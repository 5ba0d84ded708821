// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/exact_frequencies.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <hwy/aligned_allocator.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/error/reasons.h"
#include "core/error/row_sums.h"
#include "core/task/error.h"

namespace pellucid::error {

namespace {

using Complex = std::complex<double>;
constexpr int lanes = RowGroup::lanes;

// Groups of rows that are folded before they are summed: their pairs stay in the cache while the
// tables of all blocks pass.
constexpr int groupsTogether = 4;

class FrequencySums {
public:
    FrequencySums(const ShownRows &rows, std::span<const glm::dvec3> frequencies)
        : m_rows(rows), m_size(rows.box().size()), m_pairs((m_size.i + 1) / 2),
          m_blocks((int(frequencies.size()) + lanes - 1) / lanes),
          m_table(hwy::AllocateAligned<float>(std::size_t(m_blocks) * m_pairs * 2 * lanes)),
          m_phases(hwy::AllocateAligned<double>(std::size_t(m_size.j) * m_blocks * 2 * lanes)),
          m_frequencies(frequencies) {
        if (!m_table || !m_phases)
            throw std::bad_alloc();
        tbb::parallel_for(0, m_blocks, [&](int block) { fillTables(block); });
    }

    std::vector<std::vector<Complex>> sum(const task::Progress &progress) {
        const auto images = std::size_t(m_rows.images());
        const std::size_t perPlane = images * std::size_t(m_blocks) * 2 * lanes;
        m_planes = hwy::AllocateAligned<double>(std::size_t(m_size.k) * perPlane);
        if (!m_planes)
            throw std::bad_alloc();
        std::fill_n(m_planes.get(), std::size_t(m_size.k) * perPlane, 0.0);
        tbb::enumerable_thread_specific<Work> works(
            [&] { return Work(m_size.i, m_pairs, images); });
        std::atomic<int> done = 0;
        tbb::parallel_for(0, m_size.k, [&](int plane) {
            progress.check();
            addPlane(plane, works.local(), m_planes.get() + std::size_t(plane) * perPlane);
            progress.report(double(++done) / m_size.k);
        });
        std::vector<std::vector<Complex>> values(images);
        const volume::Lattice &lattice = m_rows.lattice();
        const volume::VoxelBox &box = m_rows.box();
        const glm::dvec3 middle =
            lattice
                .patient(volume::VoxelPoint{{0.5 * (box.lo.i + box.hi.i - 1),
                                             0.5 * (box.lo.j + box.hi.j - 1),
                                             0.5 * (box.lo.k + box.hi.k - 1)}})
                .mm -
            lattice.center().mm;
        const double cell = lattice.cellVolumeMm3();
        for (std::size_t image = 0; image < images; ++image)
            for (std::size_t n = 0; n < m_frequencies.size(); ++n) {
                const glm::dvec3 &s = m_frequencies[n];
                const double q = glm::dot(lattice.step(2), s);
                Complex sum = 0.0;
                for (int plane = 0; plane < m_size.k; ++plane) {
                    const double *const at =
                        m_planes.get() + std::size_t(plane) * perPlane +
                        (image * std::size_t(m_blocks) + n / lanes) * 2 * lanes + n % lanes;
                    sum += Complex(at[0], at[lanes]) * turned(q, plane, m_size.k);
                }
                values[image].push_back(
                    cell * sum * std::polar(1.0, -2.0 * std::numbers::pi * glm::dot(s, middle)));
            }
        return values;
    }

private:
    // The rows of a few groups, folded.
    struct Work {
        Work(int count, int pairs, std::size_t images)
            : stride((std::size_t(pairs) + lanes - 1) / lanes * lanes),
              perImage(std::size_t(groupsTogether) * RowGroup::rows * stride),
              rows(images * std::size_t(count)), sums(images * perImage),
              differences(images * perImage) {}
        std::size_t stride, perImage;
        ShownRows::Buffers buffers;
        std::vector<float> rows, sums, differences;
    };
    struct Gathered {
        int image = 0, row = 0; ///< of the plane
        int firstPair = 0;
    };

    static Complex turned(double q, int index, int count) {
        return std::polar(1.0, -2.0 * std::numbers::pi * q * (index - 0.5 * (count - 1)));
    }

    // Beyond the last frequency, those of frequency 0, which nobody reads.
    void fillTables(int block) {
        const volume::Lattice &lattice = m_rows.lattice();
        for (int lane = 0; lane < lanes; ++lane) {
            const std::size_t n = std::size_t(block) * lanes + std::size_t(lane);
            const glm::dvec3 s = n < m_frequencies.size() ? m_frequencies[n] : glm::dvec3(0.0);
            const double x = glm::dot(lattice.step(0), s), y = glm::dot(lattice.step(1), s);
            float *table = m_table.get() + std::size_t(block) * m_pairs * 2 * lanes + lane;
            for (int pair = 0; pair < m_pairs; ++pair, table += 2 * lanes) {
                // The later sample of a pair is before the middle by this, the earlier after it.
                const double angle = 2.0 * std::numbers::pi * x * (0.5 * (m_size.i - 1) - pair);
                table[0] = float(std::cos(angle));
                table[lanes] = float(std::sin(angle));
            }
            double *phase = m_phases.get() + std::size_t(block) * 2 * lanes + lane;
            for (int row = 0; row < m_size.j; ++row, phase += std::size_t(m_blocks) * 2 * lanes) {
                const double angle = 2.0 * std::numbers::pi * y * (row - 0.5 * (m_size.j - 1));
                phase[0] = std::cos(angle);
                phase[lanes] = std::sin(angle);
            }
        }
    }

    void addPlane(int plane, Work &work, double *sums) const {
        const volume::VoxelBox &box = m_rows.box();
        const auto images = std::size_t(m_rows.images());
        std::array<std::vector<Gathered>, 3> gathered;
        const auto flush = [&](std::size_t image) {
            addGroups(gathered[image], work, image,
                      sums + image * std::size_t(m_blocks) * 2 * lanes);
            gathered[image].clear();
        };
        constexpr std::size_t together = std::size_t(groupsTogether) * RowGroup::rows;
        for (int row = 0; row < m_size.j; ++row) {
            std::array<float *, 3> rows{};
            for (std::size_t image = 0; image < images; ++image)
                rows[image] = work.rows.data() + image * std::size_t(m_size.i);
            m_rows.read(box.lo.j + row, box.lo.k + plane, work.buffers, rows);
            for (std::size_t image = 0; image < images; ++image) {
                const std::size_t at = image * work.perImage + gathered[image].size() * work.stride;
                const int first = foldRow(rows[image], m_size.i, work.sums.data() + at,
                                          work.differences.data() + at);
                if (first < 0)
                    continue;
                gathered[image].push_back({int(image), row, first});
                if (gathered[image].size() == together)
                    flush(image);
            }
        }
        for (std::size_t image = 0; image < images; ++image)
            flush(image);
    }

    void addGroups(const std::vector<Gathered> &rows, Work &work, std::size_t image,
                   double *sums) const {
        for (int block = 0; block < m_blocks; ++block)
            for (std::size_t start = 0; start < rows.size(); start += RowGroup::rows) {
                RowGroup group{.firstPair = m_pairs, .pairs = m_pairs};
                std::array<const double *, RowGroup::rows> phases{};
                for (std::size_t r = 0; r < RowGroup::rows; ++r) {
                    // A last group repeats no row: those beyond are zero.
                    const bool isRow = start + r < rows.size();
                    const Gathered &row = rows[isRow ? start + r : start];
                    const std::size_t at = image * work.perImage + (start + r) * work.stride;
                    if (!isRow) {
                        std::fill_n(work.sums.data() + at, m_pairs, 0.0F);
                        std::fill_n(work.differences.data() + at, m_pairs, 0.0F);
                    } else {
                        group.firstPair = std::min(group.firstPair, row.firstPair);
                    }
                    group.sums[r] = work.sums.data() + at;
                    group.differences[r] = work.differences.data() + at;
                    phases[r] = m_phases.get() +
                                (std::size_t(row.row) * m_blocks + std::size_t(block)) * 2 * lanes;
                }
                double *const to = sums + std::size_t(block) * 2 * lanes;
                addRows(group, m_table.get() + std::size_t(block) * m_pairs * 2 * lanes, phases, to,
                        to + lanes);
            }
    }

    const ShownRows &m_rows;
    volume::GridSize m_size;
    int m_pairs, m_blocks;
    hwy::AlignedFreeUniquePtr<float[]> m_table;   ///< [block][pair][16 cosines, 16 sines]
    hwy::AlignedFreeUniquePtr<double[]> m_phases; ///< [row][block][16 cosines, 16 sines]
    hwy::AlignedFreeUniquePtr<double[]> m_planes; ///< [plane][image][block][16 real, 16 imaginary]
    std::span<const glm::dvec3> m_frequencies;
};

} // namespace

std::vector<std::vector<Complex>> exactFrequencies(const ShownRows &rows,
                                                   std::span<const glm::dvec3> frequencies,
                                                   const task::Progress &progress) {
    if (rows.images() == 0 || frequencies.empty())
        return {};
    return task::orOutOfMemory(task::because::noMemoryForTheCheck,
                               [&] { return FrequencySums(rows, frequencies).sum(progress); });
}

} // namespace pellucid::error
