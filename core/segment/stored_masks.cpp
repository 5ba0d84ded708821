// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/stored_masks.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <tbb/parallel_for.h>

#include "core/segment/mask_stack.h"
#include "core/segment/reasons.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::segment {

namespace {

using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::VoxelBox;
using volume::VoxelIndex;

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
        return glm::compMax(glm::abs(voxel(column, row) - meant)) <= sampleTolerance;
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
    const MaskPixels pixels(masks);
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

std::vector<MaskExtent> extentsOf(const StoredMasks &masks, const MaskPixels &pixels,
                                  const task::Progress &progress) {
    std::vector<MaskExtent> extents(std::size_t(masks.segments));
    std::mutex guard;
    tbb::parallel_for(std::size_t(0), masks.planes.size(), [&](std::size_t plane) {
        progress.check();
        std::vector<MaskExtent> found(extents.size());
        for (int row = 0; row < masks.rows; ++row)
            pixels.forEachInRow(plane, row, [&](int column, int segment, int) {
                MaskExtent &extent = found[std::size_t(segment)];
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
        const MaskPixels pixels(masks);
        const std::vector<MaskExtent> extents = extentsOf(masks, pixels, progress);
        for (int segment = 0; segment < masks.segments; ++segment) {
            progress.check();
            const MaskExtent &extent = extents[std::size_t(segment)];
            if (extent.isEmpty())
                result.coverages.emplace_back();
            else
                result.coverages.push_back(interpolated(masks, pixels, segment, extent,
                                                        spacing.typical, lattice, progress));
            progress.report(double(segment + 1) / masks.segments);
        }
        return result;
    });
}

double farthestFromSamplesMm(const StoredMasks &masks, const Lattice &lattice,
                             const task::Progress &progress) {
    // The planes of different segments often are at the same place.
    std::vector<MaskPlane> planes = masks.planes;
    const auto numbers = [](const MaskPlane &plane) {
        const glm::dvec3 &o = plane.origin, &c = plane.columnStep, &r = plane.rowStep;
        return std::tuple(o.x, o.y, o.z, c.x, c.y, c.z, r.x, r.y, r.z);
    };
    std::sort(planes.begin(), planes.end(),
              [&](const MaskPlane &a, const MaskPlane &b) { return numbers(a) < numbers(b); });
    planes.erase(std::unique(planes.begin(), planes.end(),
                             [&](const MaskPlane &a, const MaskPlane &b) {
                                 return numbers(a) == numbers(b);
                             }),
                 planes.end());
    const glm::dmat3 steps(lattice.step(0), lattice.step(1), lattice.step(2));
    const glm::dvec3 size(lattice.size().i, lattice.size().j, lattice.size().k);
    std::vector<double> farthest(planes.size());
    tbb::parallel_for(std::size_t(0), planes.size(), [&](std::size_t n) {
        const MaskPlane &plane = planes[n];
        for (int row = 0; row < masks.rows; ++row) {
            progress.check();
            const glm::dvec3 first = lattice.voxel({plane.origin + double(row) * plane.rowStep}).v,
                             step = lattice.voxel({lattice.origin().mm + plane.columnStep}).v;
            for (int column = 0; column < masks.columns; ++column) {
                const glm::dvec3 at = first + double(column) * step, nearest = glm::round(at);
                const bool isInside =
                    glm::compMin(nearest) >= 0.0 && glm::compMin(size - nearest) >= 1.0;
                if (isInside && glm::compMax(glm::abs(at - nearest)) > sampleTolerance)
                    farthest[n] = std::max(farthest[n], glm::length(steps * (at - nearest)));
            }
        }
    });
    return *std::max_element(farthest.begin(), farthest.end());
}

} // namespace pellucid::segment
