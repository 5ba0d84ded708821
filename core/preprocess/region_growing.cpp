// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/region_growing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/preprocess/morphology.h"
#include "core/preprocess/reasons.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using volume::GridSize;
using volume::VoxelIndex;

// Fills along rows: each run of a row is filled at once, and its neighbours in the four adjacent
// rows are the next to be filled. ITK's filter visits sample by sample, and takes some thirty times
// as long; the tests compare with it.
class RunFill {
public:
    RunFill(const GridSize &size, Mask open) : m_size(size), m_open(std::move(open)) {}

    void from(VoxelIndex seed, const task::Progress &progress) {
        m_pending.push_back(seed);
        constexpr std::size_t runsBetweenChecks = 1 << 14;
        std::size_t runs = 0;
        while (!m_pending.empty()) {
            const VoxelIndex n = m_pending.back();
            m_pending.pop_back();
            if (m_open[m_size.offsetOf(n.i, n.j, n.k)] != 0)
                fillRun(n);
            if (++runs % runsBetweenChecks == 0) {
                progress.check();
                progress.report(double(m_count) / double(m_open.size()));
            }
        }
    }

    // The filled samples. *Requires*: `before` is the mask of open samples at the start.
    Mask filled(const Mask &before) const {
        Mask filled(before.size());
        tbb::parallel_for(0, m_size.k, [&](int k) {
            for (std::size_t n = m_size.offsetOf(0, 0, k), end = m_size.offsetOf(0, 0, k + 1);
                 n < end; ++n)
                filled[n] = std::uint8_t(before[n] & ~m_open[n]);
        });
        return filled;
    }
    // The open samples that are not filled.
    Mask takeOpen() { return std::move(m_open); }

private:
    using Row = std::uint8_t *;
    Row row(int j, int k) { return m_open.data() + m_size.offsetOf(0, j, k); }
    // The first sample with this value, or the end.
    static Row next(Row from, Row end, int value) {
        const auto found = static_cast<Row>(std::memchr(from, value, std::size_t(end - from)));
        return found != nullptr ? found : end;
    }

    void fillRun(VoxelIndex n) {
        const Row open = row(n.j, n.k);
        int first = n.i;
        while (first > 0 && open[first - 1] != 0)
            --first;
        const int end = int(next(open + n.i, open + m_size.i, 0) - open);
        std::fill(open + first, open + end, std::uint8_t(0));
        m_count += std::size_t(end - first);
        if (n.j > 0)
            addRuns(first, end, n.j - 1, n.k);
        if (n.j + 1 < m_size.j)
            addRuns(first, end, n.j + 1, n.k);
        if (n.k > 0)
            addRuns(first, end, n.j, n.k - 1);
        if (n.k + 1 < m_size.k)
            addRuns(first, end, n.j, n.k + 1);
    }

    // One sample of each open run beside a run.
    void addRuns(int first, int end, int j, int k) {
        const Row open = row(j, k), last = open + end;
        for (Row at = open + first; at != last;) {
            at = next(at, last, 1);
            if (at == last)
                break;
            m_pending.push_back({int(at - open), j, k});
            at = next(at, last, 0);
        }
    }

    GridSize m_size;
    Mask m_open;
    std::vector<VoxelIndex> m_pending;
    std::size_t m_count = 0;
};

// The centres of balls that contain a seed.
std::vector<VoxelIndex> centresNear(const volume::Lattice &lattice, const Mask &centres,
                                    const std::vector<VoxelIndex> &seeds, double radiusMm,
                                    const task::Progress &progress) {
    const GridSize size = lattice.size();
    std::vector<VoxelIndex> near;
    const auto reach = [&](int axis) {
        return int(std::min(radiusMm / lattice.spacingMm(axis), double(size[axis])));
    };
    for (const VoxelIndex &seed : seeds) {
        progress.check();
        for (int k = seed.k - reach(2); k <= seed.k + reach(2); ++k)
            for (int j = seed.j - reach(1); j <= seed.j + reach(1); ++j)
                for (int i = seed.i - reach(0); i <= seed.i + reach(0); ++i) {
                    const VoxelIndex n{i, j, k};
                    const double mm = std::hypot((i - seed.i) * lattice.spacingMm(0),
                                                 (j - seed.j) * lattice.spacingMm(1),
                                                 (k - seed.k) * lattice.spacingMm(2));
                    if (mm <= radiusMm && lattice.contains(n) &&
                        centres[size.offsetOf(i, j, k)] != 0)
                        near.push_back(n);
                }
    }
    return near;
}

// The part connected to the seeds through openings at least as wide as the leak.
Mask connectedThrough(const volume::Lattice &lattice, const Mask &mask,
                      const std::vector<VoxelIndex> &seeds, double leakMm,
                      const task::Progress &progress) {
    if (leakMm <= 0.0)
        return connected(lattice.size(), mask, seeds, progress);
    // A ball as wide as the leak rolls through the mask.
    const double radius = 0.5 * leakMm;
    const Mask centres = eroded(lattice, mask, radius, progress.part(0.0, 0.3));
    const auto near = centresNear(lattice, centres, seeds, radius, progress);
    if (near.empty())
        return Mask(mask.size());
    Mask region =
        dilated(lattice, connected(lattice.size(), centres, near, progress.part(0.3, 0.7)), radius,
                progress.part(0.7, 1.0));
    for (std::size_t n = 0; n < region.size(); ++n)
        region[n] = std::uint8_t(region[n] & mask[n]);
    return region;
}

bool isAnyIn(const Mask &mask) {
    return std::any_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; });
}

// On a coarse lattice the sample at a point may be outside the mask.
std::optional<VoxelIndex> nearestIn(const volume::Lattice &lattice, const Mask &mask,
                                    volume::PatientPoint point) {
    const glm::dvec3 v = glm::clamp(lattice.voxel(point).v, -1e9, 1e9);
    const glm::dvec3 middle = glm::round(v);
    std::optional<VoxelIndex> nearest;
    double least = 1e30;
    for (int dk = -1; dk <= 1; ++dk)
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di) {
                const VoxelIndex n{int(middle.x) + di, int(middle.y) + dj, int(middle.z) + dk};
                const double square =
                    glm::dot(glm::dvec3(n.i, n.j, n.k) - v, glm::dvec3(n.i, n.j, n.k) - v);
                if (square < least && lattice.contains(n) &&
                    mask[lattice.size().offsetOf(n.i, n.j, n.k)] != 0) {
                    nearest = n;
                    least = square;
                }
            }
    return nearest;
}

} // namespace

Mask connected(const GridSize &size, const Mask &mask, const std::vector<VoxelIndex> &seeds,
               const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheStep("connected"), [&] {
        RunFill fill(size, mask);
        for (const VoxelIndex &seed : seeds)
            if (seed.i >= 0 && seed.j >= 0 && seed.k >= 0 && seed.i < size.i && seed.j < size.j &&
                seed.k < size.k)
                fill.from(seed, progress);
        return fill.filled(mask);
    });
}

Mask connectedWith(const volume::Lattice &lattice, const Mask &mask,
                   const std::vector<volume::PatientPoint> &points, double leakMm,
                   const task::Progress &progress) {
    std::vector<VoxelIndex> seeds;
    for (const volume::PatientPoint &point : points)
        if (const auto seed = nearestIn(lattice, mask, point))
            seeds.push_back(*seed);
    return task::orOutOfMemory(task::because::noMemoryForTheStep("connected"), [&] {
        return connectedThrough(lattice, mask, seeds, leakMm, progress);
    });
}

Mask withoutHoles(const GridSize &size, const Mask &mask, const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheStep("fill"), [&] {
        // Holes are among the samples of the mask: the others are outside.
        const volume::VoxelBox box = boxAround(size, mask);
        const GridSize part = box.size();
        Mask outside(part.count());
        const auto forRows = [&](const auto &visit) {
            tbb::parallel_for(0, part.k, [&](int k) {
                for (int j = 0; j < part.j; ++j)
                    visit(size.offsetOf(box.lo.i, box.lo.j + j, box.lo.k + k),
                          part.offsetOf(0, j, k));
            });
        };
        forRows([&](std::size_t whole, std::size_t row) {
            for (int i = 0; i < part.i; ++i)
                outside[row + std::size_t(i)] = std::uint8_t(1 - mask[whole + std::size_t(i)]);
        });
        RunFill fill(part, std::move(outside));
        for (int k = 0; k < part.k; ++k)
            for (int j = 0; j < part.j; ++j) {
                const bool isInside = k > 0 && k + 1 < part.k && j > 0 && j + 1 < part.j;
                for (int i = 0; i < part.i; i += isInside && part.i > 1 ? part.i - 1 : 1)
                    fill.from({i, j, k}, progress);
            }
        const Mask holes = fill.takeOpen();
        Mask filled = mask;
        forRows([&](std::size_t whole, std::size_t row) {
            for (int i = 0; i < part.i; ++i)
                filled[whole + std::size_t(i)] |= holes[row + std::size_t(i)];
        });
        return filled;
    });
}

Mask grownRegion(const volume::Volume &volume, const Growth &growth,
                 const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    const GridSize size = lattice.size();
    return task::orOutOfMemory(task::because::noMemoryForTheStep("connected"), [&] {
        Mask inRange(size.count());
        volume.visit([&](auto samples) {
            tbb::parallel_for(0, size.k, [&](int k) {
                progress.check();
                for (std::size_t n = size.offsetOf(0, 0, k), end = size.offsetOf(0, 0, k + 1);
                     n < end; ++n) {
                    const auto value = double(samples[n]);
                    inRange[n] = value >= growth.low && value <= growth.high;
                }
            });
        });
        const auto isAnySeedIn = [&](const Mask &mask) {
            return std::any_of(growth.seeds.begin(), growth.seeds.end(), [&](const VoxelIndex &n) {
                return lattice.contains(n) && mask[size.offsetOf(n.i, n.j, n.k)] != 0;
            });
        };
        if (!isAnySeedIn(inRange))
            throw task::Error(task::ErrorCode::usage, task::because::seedOutsideRange);
        Mask region = connectedThrough(lattice, inRange, growth.seeds, growth.leakMm, progress);
        if (growth.leakMm > 0.0 && !isAnyIn(region))
            throw task::Error(task::ErrorCode::usage, task::because::seedInANarrowPlace);
        return region;
    });
}

} // namespace pellucid::preprocess
