// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/hand_regions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

#include "core/preprocess/reasons.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::LassoCut;
using classify::Region;
using classify::Stroke;
using volume::GridSize;
using volume::Lattice;
using volume::PatientPoint;
using volume::VoxelBox;
using volume::VoxelIndex;

VoxelIndex nearest(const Lattice &lattice, PatientPoint point) {
    // Far outside, an index would overflow.
    const glm::dvec3 v = glm::clamp(glm::round(lattice.voxel(point).v), -1e9, 1e9);
    return {int(v.x), int(v.y), int(v.z)};
}

double squareToSegment(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b) {
    const glm::dvec3 along = b - a, off = p - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(off, along) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 rest = off - t * along;
    return glm::dot(rest, rest);
}

// The samples that a ball on its way from a to b may cover.
VoxelBox boxAround(const Lattice &lattice, const glm::dvec3 &a, const glm::dvec3 &b,
                   double radiusMm) {
    const glm::dvec3 from = lattice.voxel({a}).v, to = lattice.voxel({b}).v;
    // An index is linear in the position: it varies by the length of its gradient times the radius.
    const glm::dmat3 gradients =
        glm::transpose(glm::inverse(glm::dmat3(lattice.step(0), lattice.step(1), lattice.step(2))));
    const GridSize size = lattice.size();
    int lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
        const double reach = radiusMm * glm::length(gradients[d]);
        const double low = std::ceil(std::min(from[d], to[d]) - reach),
                     high = std::floor(std::max(from[d], to[d]) + reach) + 1.0;
        lo[d] = int(std::clamp(low, 0.0, double(size[d])));
        hi[d] = int(std::clamp(high, double(lo[d]), double(size[d])));
    }
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

void paintSegment(const Lattice &lattice, const glm::dvec3 &a, const glm::dvec3 &b, double radiusMm,
                  Region region, std::vector<Region> &regions) {
    const VoxelBox box = boxAround(lattice, a, b, radiusMm);
    const double limit = radiusMm * radiusMm;
    tbb::parallel_for(box.lo.k, box.hi.k, [&](int k) {
        for (int j = box.lo.j; j < box.hi.j; ++j)
            for (int i = box.lo.i; i < box.hi.i; ++i)
                if (squareToSegment(lattice.patient(VoxelIndex{i, j, k}).mm, a, b) <= limit)
                    regions[lattice.size().offsetOf(i, j, k)] = region;
    });
}

// A polygon in the plane across the line of sight.
class Outline {
public:
    explicit Outline(const LassoCut &cut) : m_sight(cut.sight) {
        const glm::dvec3 other =
            std::abs(m_sight.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
        m_right = glm::normalize(glm::cross(other, m_sight));
        m_up = glm::cross(m_sight, m_right);
        for (const PatientPoint &corner : cut.outline)
            m_corners.push_back(seen(corner.mm));
    }

    glm::dvec2 seen(const glm::dvec3 &mm) const {
        return {glm::dot(mm, m_right), glm::dot(mm, m_up)};
    }

    // Where the outline crosses the line from + t direction, and which way: +1 or -1. Corners on
    // the line count as on its left.
    void crossings(const glm::dvec2 &from, const glm::dvec2 &direction,
                   std::vector<std::pair<double, int>> &found) const {
        found.clear();
        const auto side = [&](const glm::dvec2 &p) {
            const glm::dvec2 off = p - from;
            return direction.x * off.y - direction.y * off.x;
        };
        const double length2 = glm::dot(direction, direction);
        glm::dvec2 a = m_corners.back();
        double sideOfA = side(a);
        for (const glm::dvec2 &b : m_corners) {
            const double sideOfB = side(b);
            if ((sideOfA >= 0.0) != (sideOfB >= 0.0)) {
                const glm::dvec2 at = a + sideOfA / (sideOfA - sideOfB) * (b - a);
                found.emplace_back(glm::dot(at - from, direction) / length2,
                                   sideOfB >= 0.0 ? 1 : -1);
            }
            a = b;
            sideOfA = sideOfB;
        }
        std::sort(found.begin(), found.end());
    }

private:
    glm::dvec3 m_sight, m_right, m_up;
    std::vector<glm::dvec2> m_corners;
};

// Calls `inside(i)` for the samples of a row that are in the prism.
class RowsInPrism {
public:
    RowsInPrism(const Lattice &lattice, const LassoCut &cut)
        : m_lattice(lattice), m_cut(cut), m_outline(cut),
          m_direction(m_outline.seen(lattice.step(0))),
          // Rows along the line of sight are seen as points.
          m_isSeenAsPoint(glm::length(m_direction) < 1e-9 * lattice.spacingMm(0)) {}

    template <class F>
    void row(int j, int k, std::vector<std::pair<double, int>> &buffer, const F &inside) const {
        const glm::dvec3 first = m_lattice.patient(VoxelIndex{0, j, k}).mm;
        const glm::dvec2 from = m_outline.seen(first);
        const int count = m_lattice.size().i;
        const auto add = [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                if (isInSlab(first + double(i) * m_lattice.step(0)))
                    inside(i);
        };
        if (m_isSeenAsPoint) {
            m_outline.crossings(from, {1.0, 0.0}, buffer);
            int winding = 0;
            for (const auto &[at, way] : buffer)
                winding += at <= 0.0 ? way : 0;
            if (winding != 0)
                add(0, count);
            return;
        }
        m_outline.crossings(from, m_direction, buffer);
        int winding = 0;
        for (std::size_t n = 0; n < buffer.size(); ++n) {
            winding += buffer[n].second;
            if (winding == 0)
                continue;
            const auto index = [&](double t) {
                return int(std::clamp(std::ceil(t), 0.0, double(count)));
            };
            add(index(buffer[n].first), index(buffer[n + 1].first));
        }
    }

private:
    bool isInSlab(const glm::dvec3 &mm) const {
        if (!m_cut.slabMm)
            return true;
        const double depth = glm::dot(mm, m_cut.sight);
        return depth >= (*m_cut.slabMm)[0] && depth <= (*m_cut.slabMm)[1];
    }

    const Lattice &m_lattice;
    const LassoCut &m_cut;
    Outline m_outline;
    glm::dvec2 m_direction;
    bool m_isSeenAsPoint;
};

void apply(const Lattice &lattice, const LassoCut &cut, Mask &mask,
           const task::Progress &progress) {
    const RowsInPrism prism(lattice, cut);
    const GridSize size = lattice.size();
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        std::vector<std::pair<double, int>> buffer;
        std::vector<std::uint8_t> isInside(std::size_t(size.i));
        for (int j = 0; j < size.j; ++j) {
            std::fill(isInside.begin(), isInside.end(), std::uint8_t(0));
            prism.row(j, k, buffer, [&](int i) { isInside[std::size_t(i)] = 1; });
            std::uint8_t *const row = mask.data() + size.offsetOf(0, j, k);
            for (int i = 0; i < size.i; ++i)
                if ((isInside[std::size_t(i)] != 0) != cut.keeps)
                    row[i] = 0;
        }
    });
}

} // namespace

void paint(const Lattice &lattice, const std::vector<Stroke> &strokes, std::vector<Region> &regions,
           const task::Progress &progress) {
    for (std::size_t n = 0; n < strokes.size(); ++n) {
        const Stroke &stroke = strokes[n];
        const Region region = stroke.erases ? Region::outside : Region::filled;
        for (std::size_t p = 0; p < stroke.path.size(); ++p) {
            progress.check();
            const glm::dvec3 &at = stroke.path[p].mm;
            paintSegment(lattice, stroke.path[p > 0 ? p - 1 : 0].mm, at, stroke.radiusMm, region,
                         regions);
            if (const VoxelIndex center = nearest(lattice, {at}); lattice.contains(center))
                regions[lattice.size().offsetOf(center.i, center.j, center.k)] = region;
        }
        progress.report(double(n + 1) / double(strokes.size()));
    }
}

Mask remaining(const Lattice &lattice, const std::vector<LassoCut> &cuts,
               const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheStep("scissors"), [&] {
        Mask mask(lattice.size().count(), 1);
        for (std::size_t n = 0; n < cuts.size(); ++n) {
            apply(lattice, cuts[n], mask, progress);
            progress.report(double(n + 1) / double(cuts.size()));
        }
        return mask;
    });
}

} // namespace pellucid::preprocess
