// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/mask_stack.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <tbb/parallel_for.h>

#include "core/system/memory.h"

namespace pellucid::segment {

namespace {

using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::VoxelBox;

// The planes of one segment as a stack whose values are interpolated. Planes at about one position
// are one level. How far apart neighbouring levels may be is judged by the distances beside them,
// because the spacing of a scan may change.
class MaskStack {
public:
    // `thicknessMm`: the typical distance between planes of all segments.
    MaskStack(const StoredMasks &masks, const MaskPixels &pixels, int segment,
              const MaskExtent &extent, double thicknessMm)
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
    // No scan that is stored slice by slice has a wider spacing.
    static constexpr double widestSpacing = 2.5; // of the stated thickness

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
    const MaskPixels &m_pixels;
    int m_segment;
    const MaskExtent &m_extent;
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
                    used = united(used, {{i, j, k}, {i + 1, j + 1, k + 1}});
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

} // namespace

Coverage interpolated(const StoredMasks &masks, const MaskPixels &pixels, int segment,
                      const MaskExtent &extent, double thicknessMm, const Lattice &lattice,
                      const task::Progress &progress) {
    const MaskStack stack(masks, pixels, segment, extent, thicknessMm);
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

} // namespace pellucid::segment
