// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/stored_masks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <tbb/parallel_for.h>

#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::segment {

namespace {

using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::VoxelBox;
using volume::VoxelIndex;

// Of a step: how far a pixel may lie from a sample that it belongs to.
constexpr double tolerance = 0.05;

class Pixels {
public:
    explicit Pixels(const StoredMasks &masks) : m_masks(masks) {}

    // Calls f(column, segment, share) for each pixel of a row that belongs to a segment.
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
                    f(c, segment, Coverage::whole);
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
                f(int(bit - first) + std::countr_zero(bits), own, Coverage::whole);
            bit += count;
        }
    }

    // The share of a pixel that belongs to a segment, 0 to 255; 0 beyond the plane.
    int at(std::size_t plane, int column, int row, int segment) const {
        if (column < 0 || row < 0 || column >= m_masks.columns || row >= m_masks.rows)
            return 0;
        const std::size_t n = offsetOf(plane, row) + std::size_t(column);
        switch (m_masks.kind) {
        case StoredMasks::Pixels::bits:
            return (std::to_integer<int>(m_masks.pixels[n / 8]) >> (n % 8) & 1) * Coverage::whole;
        case StoredMasks::Pixels::fractions:
            return share(word(n));
        case StoredMasks::Pixels::labels:
            return m_masks.segmentOfLabel[word(n)] == segment ? Coverage::whole : 0;
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
        return std::min((2 * Coverage::whole * int(fraction) + most) / (2 * most), Coverage::whole);
    }

    const StoredMasks &m_masks;
};

void grow(VoxelBox &box, VoxelIndex n) {
    box = united(box, {n, {n.i + 1, n.j + 1, n.k + 1}});
}

// A plane whose pixels are samples of a lattice.
struct SampledPlane {
    glm::ivec3 origin, columnStep, rowStep; // samples
    VoxelIndex at(int column, int row) const {
        const glm::ivec3 n = origin + column * columnStep + row * rowStep;
        return {n.x, n.y, n.z};
    }
};

std::optional<SampledPlane> onSamples(const MaskPlane &plane, const StoredMasks &masks,
                                      const Lattice &lattice) {
    const auto voxel = [&](double column, double row) {
        return lattice.voxel({plane.origin + column * plane.columnStep + row * plane.rowStep}).v;
    };
    const double right = masks.columns - 1, down = masks.rows - 1;
    const glm::dvec3 origin = voxel(0, 0), first = glm::round(origin);
    const glm::dvec3 columnStep = glm::round(voxel(1, 0) - origin),
                     rowStep = glm::round(voxel(0, 1) - origin);
    // Along one axis each, one sample for each pixel.
    if (glm::length(columnStep) != 1.0 || glm::length(rowStep) != 1.0 ||
        glm::dot(columnStep, rowStep) != 0.0)
        return std::nullopt;
    const auto isNear = [&](double column, double row) {
        const glm::dvec3 meant = first + column * columnStep + row * rowStep;
        return glm::compMax(glm::abs(voxel(column, row) - meant)) <= tolerance;
    };
    if (!isNear(0, 0) || !isNear(right, 0) || !isNear(0, down) ||
        glm::compMax(glm::abs(first)) > 1e6)
        return std::nullopt;
    return SampledPlane{glm::ivec3(first), glm::ivec3(columnStep), glm::ivec3(rowStep)};
}

// The smallest and the typical distance between neighbouring planes, or the stated thickness, if
// that is smaller: planes without a pixel need not be stored. 0 if neither is known.
struct Spacing {
    double smallest, typical;
};

Spacing spacingOf(const StoredMasks &masks) {
    const MaskPlane &first = masks.planes.front();
    const glm::dvec3 normal = glm::normalize(glm::cross(first.columnStep, first.rowStep));
    std::vector<double> positions, gaps;
    for (const MaskPlane &plane : masks.planes)
        positions.push_back(glm::dot(plane.origin, normal));
    std::sort(positions.begin(), positions.end());
    constexpr double roundingMm = 0.05; // of positions that are written differently
    for (std::size_t n = 1; n < positions.size(); ++n)
        if (const double gap = positions[n] - positions[n - 1]; gap > roundingMm)
            gaps.push_back(gap);
    const double stated = masks.thicknessMm;
    if (gaps.empty())
        return {stated, stated};
    const double smallest = *std::min_element(gaps.begin(), gaps.end());
    // The larger half is not affected by planes of one segment between those of another.
    const auto typical = gaps.begin() + std::ptrdiff_t(gaps.size() * 3 / 4);
    std::nth_element(gaps.begin(), typical, gaps.end());
    const auto orStated = [&](double gap) { return stated > 0.0 ? std::min(gap, stated) : gap; };
    return {orStated(smallest), orStated(*typical)};
}

// All planes on the samples of the lattice, unless they are thicker than its slices.
std::optional<std::vector<SampledPlane>> allOnSamples(const StoredMasks &masks,
                                                      const Lattice &lattice, double thicknessMm) {
    std::vector<SampledPlane> planes;
    for (const MaskPlane &plane : masks.planes) {
        const auto sampled = onSamples(plane, masks, lattice);
        if (!sampled)
            return std::nullopt;
        planes.push_back(*sampled);
    }
    const SampledPlane &one = planes.front();
    // A plane covers as much of the third axis as its thickness.
    const glm::ivec3 used = glm::abs(one.columnStep) + glm::abs(one.rowStep);
    const int across = used.x == 0 ? 0 : used.y == 0 ? 1 : 2;
    const glm::dvec3 normal =
        glm::normalize(glm::cross(masks.planes.front().columnStep, masks.planes.front().rowStep));
    const double step = std::abs(glm::dot(lattice.step(across), normal));
    constexpr double thickest = 1.5; // of a step
    if (thicknessMm > thickest * step)
        return std::nullopt;
    return planes;
}

PlacedMasks placedOnSamples(const StoredMasks &masks, const Lattice &lattice,
                            const std::vector<SampledPlane> &planes,
                            const task::Progress &progress) {
    const Pixels pixels(masks);
    std::vector<VoxelBox> boxes(std::size_t(masks.segments));
    std::mutex guard;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t(0), planes.size(), [&](std::size_t plane) {
        progress.check();
        std::vector<VoxelBox> found(boxes.size());
        for (int row = 0; row < masks.rows; ++row)
            pixels.forEachInRow(plane, row, [&](int column, int segment, int) {
                if (const VoxelIndex n = planes[plane].at(column, row); lattice.contains(n))
                    grow(found[std::size_t(segment)], n);
            });
        const std::lock_guard lock(guard);
        for (std::size_t s = 0; s < boxes.size(); ++s)
            boxes[s] = united(boxes[s], found[s]);
        progress.report(0.5 * double(++done) / double(planes.size()));
    });
    double bytes = 0.0;
    for (const VoxelBox &box : boxes)
        bytes += double(box.size().count());
    system::requireMemory(bytes);
    PlacedMasks result;
    for (const VoxelBox &box : boxes)
        result.coverages.push_back({box, std::vector<std::uint8_t>(box.size().count())});
    // Rows of one plane are different samples; different planes need not be.
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        progress.check();
        tbb::parallel_for(0, masks.rows, [&](int row) {
            pixels.forEachInRow(plane, row, [&](int column, int segment, int share) {
                const VoxelIndex n = planes[plane].at(column, row);
                Coverage &coverage = result.coverages[std::size_t(segment)];
                if (!coverage.box.contains(n))
                    return;
                std::uint8_t &sample = coverage.shares[coverage.offsetOf(n)];
                sample = std::max(sample, std::uint8_t(share));
            });
        });
        progress.report(0.5 + 0.5 * double(plane + 1) / double(planes.size()));
    }
    return result;
}

// The columns and rows that a segment uses in any plane.
struct Extent {
    glm::ivec2 low{1 << 30}, high{-1};
    bool isEmpty() const { return high.x < 0; }
};

std::vector<Extent> extentsOf(const StoredMasks &masks, const Pixels &pixels,
                              const task::Progress &progress) {
    std::vector<Extent> extents(std::size_t(masks.segments));
    std::mutex guard;
    tbb::parallel_for(std::size_t(0), masks.planes.size(), [&](std::size_t plane) {
        progress.check();
        std::vector<Extent> found(extents.size());
        for (int row = 0; row < masks.rows; ++row)
            pixels.forEachInRow(plane, row, [&](int column, int segment, int) {
                Extent &extent = found[std::size_t(segment)];
                extent.low = glm::min(extent.low, glm::ivec2(column, row));
                extent.high = glm::max(extent.high, glm::ivec2(column, row));
            });
        const std::lock_guard lock(guard);
        for (std::size_t s = 0; s < extents.size(); ++s) {
            extents[s].low = glm::min(extents[s].low, found[s].low);
            extents[s].high = glm::max(extents[s].high, found[s].high);
        }
    });
    return extents;
}

// The planes of one segment as a stack whose values are interpolated. Planes at about one position
// are one level. How far apart neighbouring levels may be is judged by the distances beside them,
// because the spacing of a scan may change.
class MaskStack {
public:
    // `thicknessMm`: the typical distance between planes of all segments.
    MaskStack(const StoredMasks &masks, const Pixels &pixels, int segment, const Extent &extent,
              double thicknessMm)
        : m_masks(masks), m_pixels(pixels), m_segment(segment), m_extent(extent),
          m_thickness(thicknessMm > 0.0 ? thicknessMm : 1.0) {
        const MaskPlane &first = masks.planes.front();
        m_origin = first.origin;
        m_normal = glm::normalize(glm::cross(first.columnStep, first.rowStep));
        m_toPixels = glm::inverse(glm::dmat3(first.columnStep, first.rowStep, m_normal));
        std::vector<Plane> planes;
        // A label map has planes without a pixel of the segment, between which it ends.
        for (std::size_t n = 0; n < masks.planes.size(); ++n)
            if (masks.kind == StoredMasks::Pixels::labels || masks.planes[n].segment == segment)
                planes.push_back(planeOf(n));
        std::sort(planes.begin(), planes.end(),
                  [](const Plane &a, const Plane &b) { return a.at < b.at; });
        for (const Plane &plane : planes) {
            if (m_levels.empty() || plane.at - m_levels.back().at > samePlace * m_thickness)
                m_levels.push_back({plane.at, {}, false});
            m_levels.back().planes.push_back(plane);
        }
        joinLevels();
    }

    double thicknessMm() const { return m_thickness; }

    // The samples of a lattice that the segment may reach.
    VoxelBox boxIn(const Lattice &lattice) const {
        glm::dvec3 low{1e30}, high{-1e30};
        for (int corner = 0; corner < 8; ++corner) {
            // A plane may have its origin elsewhere than the first.
            const double reach = 1.0 + m_largestShift;
            const double c = (corner & 1) != 0 ? m_extent.high.x + reach : m_extent.low.x - reach,
                         r = (corner & 2) != 0 ? m_extent.high.y + reach : m_extent.low.y - reach,
                         z = (corner & 4) != 0 ? m_levels.back().at + m_longestFade
                                               : m_levels.front().at - m_longestFade;
            const MaskPlane &first = m_masks.planes.front();
            const glm::dvec3 v =
                lattice.voxel({m_origin + c * first.columnStep + r * first.rowStep + z * m_normal})
                    .v;
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        const GridSize n = lattice.size();
        const glm::dvec3 from = glm::clamp(glm::floor(low), glm::dvec3(0.0),
                                           glm::dvec3(n.i, n.j, n.k)),
                         to = glm::clamp(glm::ceil(high) + 1.0, from, glm::dvec3(n.i, n.j, n.k));
        return {{int(from.x), int(from.y), int(from.z)}, {int(to.x), int(to.y), int(to.z)}};
    }

    // The interpolated share at a point, 0 to 255.
    double at(glm::dvec3 pointMm) const {
        const glm::dvec3 p = m_toPixels * (pointMm - m_origin);
        const auto above =
            std::upper_bound(m_levels.begin(), m_levels.end(), p.z,
                             [](double z, const Level &level) { return z < level.at; });
        const auto next = std::size_t(above - m_levels.begin());
        double sum = 0.0;
        if (next > 0)
            sum += part(p.z - m_levels[next - 1].at, fadeAbove(next - 1)) *
                   inLevel(m_levels[next - 1], p);
        if (next < m_levels.size())
            sum += part(m_levels[next].at - p.z, fadeBelow(next)) * inLevel(m_levels[next], p);
        return sum;
    }

private:
    static constexpr double samePlace = 0.2; // of the thickness
    // Of the stated thickness: no scan that is stored slice by slice has a wider spacing.
    static constexpr double widestSpacing = 2.5;

    struct Plane {
        std::size_t index;
        double at;             // along the normal, mm
        double shiftX, shiftY; // of its origin within the plane, pixels
    };
    struct Level {
        double at;
        std::vector<Plane> planes;
        bool isJoined; // to the next one: there is no gap between them
    };

    Plane planeOf(std::size_t n) {
        const glm::dvec3 origin = m_toPixels * (m_masks.planes[n].origin - m_origin);
        m_largestShift = std::max({m_largestShift, std::abs(origin.x), std::abs(origin.y)});
        return {n, origin.z, origin.x, origin.y};
    }

    double gapAfter(std::size_t level) const { return m_levels[level + 1].at - m_levels[level].at; }

    void joinLevels() {
        const double stated = m_masks.thicknessMm;
        for (std::size_t n = 0; n + 1 < m_levels.size(); ++n) {
            double beside = 0.0;
            if (n > 0)
                beside = gapAfter(n - 1);
            if (n + 2 < m_levels.size())
                beside = std::max(beside, gapAfter(n + 1));
            if (beside == 0.0) // of two levels
                beside = m_thickness;
            const double gap = gapAfter(n);
            m_levels[n].isJoined = gap <= m_masks.longestGap * beside &&
                                   (stated == 0.0 || gap <= widestSpacing * stated);
        }
        for (std::size_t n = 0; n < m_levels.size(); ++n)
            m_longestFade = std::max({m_longestFade, fadeAbove(n), fadeBelow(n)});
    }

    // The distance over which a level fades: that to the next, or, at an end, that on its other
    // side.
    double fadeAbove(std::size_t level) const {
        if (m_levels[level].isJoined)
            return gapAfter(level);
        return level > 0 && m_levels[level - 1].isJoined ? gapAfter(level - 1) : m_thickness;
    }
    double fadeBelow(std::size_t level) const {
        if (level > 0 && m_levels[level - 1].isJoined)
            return gapAfter(level - 1);
        return m_levels[level].isJoined ? gapAfter(level) : m_thickness;
    }

    static double part(double distance, double fade) {
        return distance < fade ? 1.0 - distance / fade : 0.0;
    }

    double inLevel(const Level &level, const glm::dvec3 &p) const {
        double most = 0.0;
        for (const Plane &plane : level.planes)
            most = std::max(most, inPlane(plane, p));
        return most;
    }

    double inPlane(const Plane &plane, const glm::dvec3 &p) const {
        const double x = p.x - plane.shiftX, y = p.y - plane.shiftY;
        const double c = std::floor(x), r = std::floor(y), u = x - c, v = y - r;
        if (!(c >= -1.0 && r >= -1.0 && c <= m_masks.columns && r <= m_masks.rows))
            return 0.0;
        const auto at = [&](int i, int j) {
            return double(m_pixels.at(plane.index, int(c) + i, int(r) + j, m_segment));
        };
        return (1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) +
               v * ((1.0 - u) * at(0, 1) + u * at(1, 1));
    }

    const StoredMasks &m_masks;
    const Pixels &m_pixels;
    int m_segment;
    const Extent &m_extent;
    double m_thickness;
    glm::dvec3 m_origin, m_normal;
    glm::dmat3 m_toPixels;
    std::vector<Level> m_levels;
    double m_largestShift = 0.0, m_longestFade = 0.0;
};

// The points within a cell of a lattice at which finer masks are read.
std::vector<glm::dvec3> pointsInCell(const Lattice &lattice, const StoredMasks &masks,
                                     double thicknessMm) {
    constexpr int most = 4;
    const MaskPlane &plane = masks.planes.front();
    const double finest =
        std::min({glm::length(plane.columnStep), glm::length(plane.rowStep), thicknessMm});
    glm::ivec3 count{1};
    for (int axis = 0; axis < 3; ++axis)
        count[axis] = std::clamp(int(std::lround(lattice.spacingMm(axis) / finest)), 1, most);
    std::vector<glm::dvec3> points;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x)
                points.push_back((glm::dvec3(x, y, z) + 0.5) / glm::dvec3(count) - 0.5);
    return points;
}

// The smallest box with all shares that are not 0.
Coverage trimmed(const VoxelBox &box, const std::vector<std::uint8_t> &shares) {
    VoxelBox used;
    const GridSize size = box.size();
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                if (shares[size.offsetOf(i, j, k)] != 0)
                    grow(used, {i, j, k});
    Coverage result{{{used.lo.i + box.lo.i, used.lo.j + box.lo.j, used.lo.k + box.lo.k},
                     {used.hi.i + box.lo.i, used.hi.j + box.lo.j, used.hi.k + box.lo.k}},
                    {}};
    result.shares.reserve(used.size().count());
    for (int k = used.lo.k; k < used.hi.k; ++k)
        for (int j = used.lo.j; j < used.hi.j; ++j) {
            const auto from = shares.begin() + std::ptrdiff_t(size.offsetOf(used.lo.i, j, k));
            result.shares.insert(result.shares.end(), from, from + used.size().i);
        }
    return result;
}

Coverage resampled(const MaskStack &stack, const StoredMasks &masks, const Lattice &lattice,
                   const task::Progress &progress) {
    const VoxelBox box = stack.boxIn(lattice);
    const GridSize size = box.size();
    if (size.count() == 0)
        return {};
    system::requireMemory(2.0 * double(size.count()));
    const auto points = pointsInCell(lattice, masks, stack.thicknessMm());
    std::vector<std::uint8_t> shares(size.count());
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                double sum = 0.0;
                for (const glm::dvec3 &within : points)
                    sum += stack.at(
                        lattice
                            .patient(volume::VoxelPoint{
                                glm::dvec3(box.lo.i + i, box.lo.j + j, box.lo.k + k) + within})
                            .mm);
                shares[size.offsetOf(i, j, k)] =
                    std::uint8_t(std::lround(sum / double(points.size())));
            }
    });
    return trimmed(box, shares);
}

void requireParallel(const StoredMasks &masks) {
    const MaskPlane &first = masks.planes.front();
    const auto isNear = [](const glm::dvec3 &a, const glm::dvec3 &b) {
        return glm::length(a - b) <= 1e-3 * glm::length(b);
    };
    for (const MaskPlane &plane : masks.planes)
        if (!isNear(plane.columnStep, first.columnStep) || !isNear(plane.rowStep, first.rowStep))
            throw task::Error(task::ErrorCode::unusable, task::because::planesOfMasksDiffer);
}

} // namespace

PlacedMasks placed(const StoredMasks &masks, const Lattice &lattice,
                   const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheSegments, [&] {
        const Spacing spacing = spacingOf(masks);
        if (const auto planes = allOnSamples(masks, lattice, spacing.smallest))
            return placedOnSamples(masks, lattice, *planes, progress);
        requireParallel(masks);
        PlacedMasks result{{}, true};
        const Pixels pixels(masks);
        const std::vector<Extent> extents = extentsOf(masks, pixels, progress);
        for (int segment = 0; segment < masks.segments; ++segment) {
            progress.check();
            const Extent &extent = extents[std::size_t(segment)];
            if (extent.isEmpty())
                result.coverages.emplace_back();
            else
                result.coverages.push_back(
                    resampled(MaskStack(masks, pixels, segment, extent, spacing.typical), masks,
                              lattice, progress));
            progress.report(double(segment + 1) / masks.segments);
        }
        return result;
    });
}

} // namespace pellucid::segment
