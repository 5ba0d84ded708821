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
#include <glm/vec3.hpp>

#include <tbb/parallel_for.h>

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
// Of the thickness: planes farther apart have a gap between them.
constexpr double longestGap = 1.5;

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

void include(VoxelBox &box, VoxelIndex n) {
    if (box.size().count() == 0) {
        box = {n, {n.i + 1, n.j + 1, n.k + 1}};
        return;
    }
    box = {{std::min(box.lo.i, n.i), std::min(box.lo.j, n.j), std::min(box.lo.k, n.k)},
           {std::max(box.hi.i, n.i + 1), std::max(box.hi.j, n.j + 1), std::max(box.hi.k, n.k + 1)}};
}

bool isIn(const VoxelBox &box, VoxelIndex n) {
    return n.i >= box.lo.i && n.i < box.hi.i && n.j >= box.lo.j && n.j < box.hi.j &&
           n.k >= box.lo.k && n.k < box.hi.k;
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

// The smallest distance between planes, or the stated thickness, if that is smaller: planes without
// a pixel need not be stored. 0 if neither is known.
double thicknessOf(const StoredMasks &masks) {
    const MaskPlane &first = masks.planes.front();
    const glm::dvec3 normal = glm::normalize(glm::cross(first.columnStep, first.rowStep));
    std::vector<double> positions;
    for (const MaskPlane &plane : masks.planes)
        positions.push_back(glm::dot(plane.origin, normal));
    std::sort(positions.begin(), positions.end());
    double thickness = masks.thicknessMm;
    for (std::size_t n = 1; n < positions.size(); ++n)
        if (const double gap = positions[n] - positions[n - 1];
            gap > 1e-3 && (thickness == 0.0 || gap < thickness))
            thickness = gap;
    return thickness;
}

// All planes on the samples of the lattice, unless they are thicker than its slices.
std::optional<std::vector<SampledPlane>> allOnSamples(const StoredMasks &masks,
                                                      const Lattice &lattice) {
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
    if (thicknessOf(masks) > longestGap * step)
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
                    include(found[std::size_t(segment)], n);
            });
        const std::lock_guard lock(guard);
        for (std::size_t s = 0; s < boxes.size(); ++s)
            boxes[s] = united(boxes[s], found[s]);
        progress.report(0.5 * double(++done) / double(planes.size()));
    });
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
                if (!isIn(coverage.box, n))
                    return;
                std::uint8_t &sample = coverage.shares[coverage.offsetOf(n)];
                sample = std::max(sample, std::uint8_t(share));
            });
        });
        progress.report(0.5 + 0.5 * double(plane + 1) / double(planes.size()));
    }
    return result;
}

// The planes of one segment as a stack whose values are interpolated.
class MaskStack {
public:
    MaskStack(const StoredMasks &masks, const Pixels &pixels, int segment)
        : m_masks(masks), m_pixels(pixels), m_segment(segment) {
        const MaskPlane &first = masks.planes.front();
        m_origin = first.origin;
        m_normal = glm::normalize(glm::cross(first.columnStep, first.rowStep));
        m_toPixels = glm::inverse(glm::dmat3(first.columnStep, first.rowStep, m_normal));
        for (std::size_t n = 0; n < masks.planes.size(); ++n)
            if (masks.kind == StoredMasks::Pixels::labels || masks.planes[n].segment == segment)
                addPlane(n);
        std::sort(m_planes.begin(), m_planes.end(),
                  [](const Plane &a, const Plane &b) { return a.at < b.at; });
        if (const double known = thicknessOf(masks); known > 0.0)
            m_thickness = known;
        findExtent();
    }

    bool isEmpty() const { return m_lowColumn > m_highColumn; }
    double thicknessMm() const { return m_thickness; }

    // The samples of a lattice that the segment may reach.
    VoxelBox boxIn(const Lattice &lattice) const {
        glm::dvec3 low{1e30}, high{-1e30};
        for (int corner = 0; corner < 8; ++corner) {
            const double c = (corner & 1) != 0 ? m_highColumn + 1 : m_lowColumn - 1,
                         r = (corner & 2) != 0 ? m_highRow + 1 : m_lowRow - 1,
                         z = (corner & 4) != 0 ? m_highAt + m_thickness : m_lowAt - m_thickness;
            const MaskPlane &first = m_masks.planes.front();
            // A shifted plane has its own origin, so that the box includes the largest shift.
            for (const double shift : {-m_largestShift, m_largestShift}) {
                const glm::dvec3 v = lattice
                                         .voxel({m_origin + (c + shift) * first.columnStep +
                                                 (r + shift) * first.rowStep + z * m_normal})
                                         .v;
                low = glm::min(low, v);
                high = glm::max(high, v);
            }
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
            std::upper_bound(m_planes.begin(), m_planes.end(), p.z,
                             [](double z, const Plane &plane) { return z < plane.at; });
        const Plane *const lower = above == m_planes.begin() ? nullptr : &*std::prev(above);
        const Plane *const upper = above == m_planes.end() ? nullptr : &*above;
        const bool isGap = lower == nullptr || upper == nullptr ||
                           upper->at - lower->at > longestGap * m_thickness;
        const double reach = isGap ? m_thickness : upper->at - lower->at;
        double sum = 0.0;
        if (lower != nullptr && p.z - lower->at < reach)
            sum += (1.0 - (p.z - lower->at) / reach) * inPlane(*lower, p);
        if (upper != nullptr && upper->at - p.z < reach)
            sum += (1.0 - (upper->at - p.z) / reach) * inPlane(*upper, p);
        return sum;
    }

private:
    struct Plane {
        std::size_t index;
        double at;             // along the normal, mm
        double shiftX, shiftY; // of its origin within the plane, pixels
    };

    void addPlane(std::size_t n) {
        const MaskPlane &plane = m_masks.planes[n];
        const glm::dvec3 origin = m_toPixels * (plane.origin - m_origin);
        m_planes.push_back({n, origin.z, origin.x, origin.y});
        m_largestShift = std::max({m_largestShift, std::abs(origin.x), std::abs(origin.y)});
    }

    void findExtent() {
        for (const Plane &plane : m_planes)
            for (int row = 0; row < m_masks.rows; ++row)
                m_pixels.forEachInRow(plane.index, row, [&](int column, int segment, int) {
                    if (segment != m_segment)
                        return;
                    m_lowColumn = std::min(m_lowColumn, column);
                    m_highColumn = std::max(m_highColumn, column);
                    m_lowRow = std::min(m_lowRow, row);
                    m_highRow = std::max(m_highRow, row);
                    m_lowAt = std::min(m_lowAt, plane.at);
                    m_highAt = std::max(m_highAt, plane.at);
                });
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
    glm::dvec3 m_origin, m_normal;
    glm::dmat3 m_toPixels;
    std::vector<Plane> m_planes;
    double m_thickness = 1.0, m_largestShift = 0.0;
    int m_lowColumn = 1 << 30, m_highColumn = -1, m_lowRow = 1 << 30, m_highRow = -1;
    double m_lowAt = 1e30, m_highAt = -1e30;
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
                    include(used, {i, j, k});
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

Coverage resampled(const StoredMasks &masks, const Pixels &pixels, int segment,
                   const Lattice &lattice, const task::Progress &progress) {
    const MaskStack stack(masks, pixels, segment);
    if (stack.isEmpty())
        return {};
    const VoxelBox box = stack.boxIn(lattice);
    const GridSize size = box.size();
    if (size.count() == 0)
        return {};
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
        if (const auto planes = allOnSamples(masks, lattice))
            return placedOnSamples(masks, lattice, *planes, progress);
        requireParallel(masks);
        PlacedMasks result{{}, true};
        const Pixels pixels(masks);
        for (int segment = 0; segment < masks.segments; ++segment) {
            result.coverages.push_back(resampled(masks, pixels, segment, lattice, progress));
            progress.report(double(segment + 1) / masks.segments);
        }
        return result;
    });
}

} // namespace pellucid::segment
