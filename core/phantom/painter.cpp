// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/phantom/painter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

namespace pellucid::phantom {

using glm::dquat;
using glm::dvec3;

Shape ellipsoid(dvec3 center, dvec3 radii, dquat rotation) {
    const double reach = std::max({radii.x, radii.y, radii.z});
    const dquat back = glm::conjugate(rotation);
    const bool aligned = rotation == dquat(1, 0, 0, 0);
    const dvec3 box = aligned ? radii : dvec3(reach);
    return {[=](const dvec3 &p) {
                const dvec3 local = aligned ? p - center : back * (p - center);
                const dvec3 unit = local / radii;
                const double r = glm::length(unit);
                if (r < 1e-9)
                    return -std::min({radii.x, radii.y, radii.z});
                // First-order distance: exact to first order at the surface, which is where it
                // counts.
                return r * (r - 1.0) / glm::length(unit / radii);
            },
            center - box, center + box};
}

Shape rod(dvec3 from, dvec3 to, double fromRadius, double toRadius) {
    const dvec3 along = to - from;
    const double square = glm::dot(along, along);
    const dvec3 reach(std::max(fromRadius, toRadius));
    return {[=](const dvec3 &p) {
                const double t =
                    square > 0.0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0.0;
                return glm::distance(p, from + t * along) -
                       (fromRadius + t * (toRadius - fromRadius));
            },
            glm::min(from, to) - reach, glm::max(from, to) + reach};
}

Shape tube(const std::vector<dvec3> &points, double radius) {
    dvec3 low = points.front(), high = points.front();
    for (const dvec3 &p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {[=](const dvec3 &p) {
                double nearest = std::numeric_limits<double>::infinity();
                for (std::size_t n = 1; n < points.size(); ++n) {
                    const dvec3 along = points[n] - points[n - 1];
                    const double t = std::clamp(
                        glm::dot(p - points[n - 1], along) / glm::dot(along, along), 0.0, 1.0);
                    const dvec3 d = p - (points[n - 1] + t * along);
                    nearest = std::min(nearest, glm::dot(d, d));
                }
                return std::sqrt(nearest) - radius;
            },
            low - dvec3(radius), high + dvec3(radius)};
}

Shape roundedBox(dvec3 center, dvec3 halfSize, double rounding, dquat rotation) {
    const double reach = glm::length(halfSize);
    const dquat back = glm::conjugate(rotation);
    const dvec3 box = rotation == dquat(1, 0, 0, 0) ? halfSize : dvec3(reach);
    return {[=](const dvec3 &p) {
                const dvec3 q = glm::abs(back * (p - center)) - halfSize + rounding;
                return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) -
                       rounding;
            },
            center - box, center + box};
}

Shape united(const Shape &a, const Shape &b, double fillet) {
    return {[=](const dvec3 &p) {
                const double da = a(p), db = b(p);
                const double overlap = std::max(fillet - std::abs(da - db), 0.0);
                return std::min(da, db) - (fillet > 0.0 ? overlap * overlap / (4.0 * fillet) : 0.0);
            },
            glm::min(a.low, b.low) - fillet, glm::max(a.high, b.high) + fillet};
}

Shape intersected(const Shape &a, const Shape &b) {
    return {[=](const dvec3 &p) { return std::max(a(p), b(p)); }, glm::max(a.low, b.low),
            glm::min(a.high, b.high)};
}

Shape without(const Shape &a, const Shape &b) {
    return {[=](const dvec3 &p) { return std::max(a(p), -b(p)); }, a.low, a.high};
}

Shape grown(const Shape &shape, double mm) {
    return {[=](const dvec3 &p) { return shape(p) - mm; }, shape.low - std::max(mm, 0.0),
            shape.high + std::max(mm, 0.0)};
}

Shape mirrored(const Shape &shape) {
    const dvec3 flip(-1, 1, 1);
    const dvec3 a = flip * shape.low, b = flip * shape.high;
    return {[=](const dvec3 &p) { return shape(flip * p); }, glm::min(a, b), glm::max(a, b)};
}

Painter::Painter(const volume::Lattice &lattice, double backgroundHu, task::Progress progress)
    : m_lattice(lattice), m_backgroundHu(backgroundHu),
      m_softnessMm(std::cbrt(lattice.cellVolumeMm3())), m_progress(std::move(progress)) {}

void Painter::paint(const Shape &shape, double hu) {
    paint(shape, [hu](const dvec3 &) { return hu; });
}

void Painter::paint(const Shape &shape, const Texture &hu) {
    // The shape's box in voxels. The map is linear, so the box's corners bound it on any lattice.
    dvec3 low(std::numeric_limits<double>::infinity()),
        high(-std::numeric_limits<double>::infinity());
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 p((corner & 1) != 0 ? shape.high.x + m_softnessMm : shape.low.x - m_softnessMm,
                      (corner & 2) != 0 ? shape.high.y + m_softnessMm : shape.low.y - m_softnessMm,
                      (corner & 4) != 0 ? shape.high.z + m_softnessMm : shape.low.z - m_softnessMm);
        const dvec3 v = m_lattice.voxel({p}).v;
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    const volume::GridSize size = m_lattice.size();
    const auto first = [](double at) { return int(std::clamp(std::floor(at), 0.0, 1e9)); };
    const auto end = [](double at, int n) {
        return int(std::clamp(std::ceil(at) + 1.0, 0.0, double(n)));
    };
    const int i0 = first(low.x), i1 = end(high.x, size.i), j0 = first(low.y),
              j1 = end(high.y, size.j);
    const int k0 = first(low.z), k1 = end(high.z, size.k);
    m_strokes.push_back({shape, hu, {{i0, j0, k0}, {i1, j1, k1}}});
}

void Painter::drawPlane(const Stroke &stroke, int k, float *plane) const {
    const auto &[shape, hu, box] = stroke;
    for (int j = box.lo.j; j < box.hi.j; ++j) {
        float *const row = plane + std::size_t(j) * std::size_t(m_lattice.size().i);
        for (int i = box.lo.i; i < box.hi.i; ++i) {
            const dvec3 p = m_lattice.patient(volume::VoxelIndex{i, j, k}).mm;
            const double covered = std::clamp(0.5 - shape(p) / m_softnessMm, 0.0, 1.0);
            if (covered > 0.0)
                row[i] += float(covered * (hu(p) - row[i]));
        }
    }
}

namespace {

// A hash of (seed, index): noise that does not depend on the order of evaluation.
std::uint32_t mixed(std::uint32_t seed, std::uint64_t index) {
    std::uint64_t x = index * 0x9E3779B97F4A7C15ULL + seed;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return std::uint32_t((x ^ (x >> 31)) >> 16);
}

double normal(std::uint32_t seed, std::uint64_t index) {
    const double a = (mixed(seed, 2 * index) + 1.0) / 4294967297.0;
    const double b = mixed(seed, 2 * index + 1) / 4294967296.0;
    return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
}

} // namespace

volume::Volume Painter::finish(double noiseHu, std::uint32_t seed, volume::VolumeNotes notes) {
    const volume::GridSize size = m_lattice.size();
    std::vector<std::int16_t> samples(size.count());
    std::atomic<int> done = 0;
    tbb::parallel_for(0, size.k, [&](int k) {
        std::vector<float> plane(std::size_t(size.i) * std::size_t(size.j), float(m_backgroundHu));
        for (const Stroke &stroke : m_strokes)
            if (k >= stroke.box.lo.k && k < stroke.box.hi.k) {
                m_progress.check();
                drawPlane(stroke, k, plane.data());
            }
        const std::size_t first = std::size_t(k) * plane.size();
        for (std::size_t n = 0; n < plane.size(); ++n) {
            const double hu = plane[n] + (noiseHu > 0.0 ? noiseHu * normal(seed, first + n) : 0.0);
            // Scanners clip at the bottom of their scale.
            samples[first + n] = std::int16_t(std::lround(std::clamp(hu, -1024.0, 32767.0)));
        }
        m_progress.report(double(++done) / size.k);
    });
    return {m_lattice, std::move(samples), volume::ValueUnit::hounsfield, std::move(notes)};
}

} // namespace pellucid::phantom
