// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/spatial_peers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "app/bench/spatial_work.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::bench {

namespace {

// A row of zeros that stands in for rows outside a slice.
const std::vector<std::int16_t> &zeroRow(std::size_t length) {
    thread_local std::vector<std::int16_t> row;
    if (row.size() < length)
        row.assign(length, 0);
    return row;
}

glm::dvec3 inVoxels(const volume::Lattice &lattice, const glm::dvec3 &mm) {
    return glm::inverse(glm::dmat3(lattice.step(0), lattice.step(1), lattice.step(2))) * mm;
}

// The slices of a volume across one of its axes; x within a slice is contiguous.
struct SliceStack {
    int columns, rows, depth;
    double perSliceX, perSliceY; ///< the shift from slice to slice, voxels
    const std::int16_t *samples;
    std::ptrdiff_t rowStride, sliceStride;
};

// The slices across the axis that is closest to the ray. *Units*: the ray in voxels.
SliceStack principalSlices(const SpatialVolume &volume, const glm::dvec3 &ray) {
    const volume::GridSize n = volume.lattice().size();
    int principal = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(ray[axis]) > std::abs(ray[principal]))
            principal = axis;
    if (principal == 0)
        return {n.k,
                n.j,
                n.i,
                -ray.z / ray.x,
                -ray.y / ray.x,
                volume.exchanged(),
                volume.exchangedRowStride(),
                volume.exchangedPlaneStride()};
    if (principal == 1)
        return {n.i,
                n.k,
                n.j,
                -ray.x / ray.y,
                -ray.z / ray.y,
                volume.samples(),
                volume.planeStride(),
                volume.rowStride()};
    return {n.i,
            n.j,
            n.k,
            -ray.x / ray.z,
            -ray.y / ray.z,
            volume.samples(),
            volume.rowStride(),
            volume.planeStride()};
}

// Shifts every slice along a ray and adds them up, in bands of rows.
class ShearWarp {
public:
    ShearWarp(const SpatialVolume &volume, const glm::dvec3 &ray)
        : m_slices(principalSlices(volume, ray)),
          m_width(extent(m_slices.columns, m_slices.perSliceX)),
          m_height(extent(m_slices.rows, m_slices.perSliceY)),
          m_firstX(firstShift(m_slices.perSliceX)), m_firstY(firstShift(m_slices.perSliceY)) {}

    SpatialImage sum() const {
        SpatialImage image{std::vector<float>(std::size_t(m_width) * m_height), m_width, m_height,
                           std::size_t(m_slices.columns) * m_slices.rows * m_slices.depth};
        tbb::parallel_for(0, (m_height + band - 1) / band,
                          [&](int part) { sumBand(part * band, image); });
        return image;
    }

private:
    static constexpr int band = 16;

    // The extent of all shifted slices.
    int extent(int size, double perSlice) const {
        return size + int(std::ceil(std::abs(perSlice) * (m_slices.depth - 1))) + 1;
    }
    // The shift of the first slice, chosen so that no shift is negative.
    double firstShift(double perSlice) const {
        return perSlice < 0.0 ? -perSlice * (m_slices.depth - 1) : 0.0;
    }

    void sumBand(int first, SpatialImage &image) const {
        const std::size_t bufferWidth = std::size_t(m_width) + SpatialVolume::gap;
        const std::int16_t *const zeros =
            zeroRow(std::size_t(m_slices.columns) + 2 * SpatialVolume::gap).data() +
            SpatialVolume::gap;
        std::vector<std::int32_t> sums(bufferWidth * band, 0);
        const int last = std::min(first + band, m_height);
        for (int slice = 0; slice < m_slices.depth; slice += shearSlices)
            for (int y = first; y < last; ++y) {
                const ShearGroup group = groupAt(slice, y, zeros);
                if (group.begin < group.end)
                    addShearedSlices(group, m_width,
                                     sums.data() + std::size_t(y - first) * bufferWidth);
            }
        for (int y = first; y < last; ++y)
            for (int x = 0; x < m_width; ++x)
                image.samples[std::size_t(y) * m_width + x] =
                    float(sums[std::size_t(y - first) * bufferWidth + x]) /
                    SpatialVolume::largestValue;
    }

    // The rows of several slices that are added to row y of the image.
    ShearGroup groupAt(int slice, int y, const std::int16_t *zeros) const {
        ShearGroup group;
        group.begin = m_width;
        for (int m = 0; m < shearSlices; ++m) {
            ShearedSlice &s = group.slices[m];
            const int k = slice + m;
            if (k >= m_slices.depth) {
                s = {zeros, zeros, 0, -SpatialVolume::gap, 0, 0};
                continue;
            }
            const double x = m_firstX + m_slices.perSliceX * k,
                         dy = m_firstY + m_slices.perSliceY * k;
            const int shift = int(std::floor(x)), shiftY = int(std::floor(dy));
            const int from = y - shiftY;
            const std::int16_t *const plane = m_slices.samples + k * m_slices.sliceStride;
            const auto at = [&](int row) {
                return row >= 0 && row < m_slices.rows ? plane + row * m_slices.rowStride : zeros;
            };
            s = {at(from),
                 at(from - 1),
                 shift,
                 m_slices.columns,
                 std::int16_t(std::min(32767.0, std::round((x - shift) * 32768.0))),
                 std::int16_t(std::min(32767.0, std::round((dy - shiftY) * 32768.0)))};
            if (s.row == zeros && s.rowBefore == zeros) {
                s.width = -SpatialVolume::gap;
                continue;
            }
            group.begin = std::min(group.begin, shift);
            group.end = std::max(group.end, shift + m_slices.columns + 1);
        }
        return group;
    }

    SliceStack m_slices;
    int m_width, m_height; ///< of the image
    double m_firstX, m_firstY;
};

} // namespace

SpatialVolume::SpatialVolume(const volume::Field &field) : m_lattice(field.lattice()) {
    const volume::GridSize n = m_lattice.size();
    const auto layOut = [](int i, int j, int k, std::ptrdiff_t &row, std::ptrdiff_t &plane,
                           std::ptrdiff_t &first) {
        row = i + gap;
        plane = row * (j + 1);
        first = plane + row + gap;
        return std::size_t(plane * (k + 3) + 2 * row + 2 * gap);
    };
    m_samples.assign(layOut(n.i, n.j, n.k, m_rowStride, m_planeStride, m_first), 0);
    m_exchanged.assign(
        layOut(n.k, n.j, n.i, m_exchangedRowStride, m_exchangedPlaneStride, m_exchangedFirst), 0);
    // The ray sum's vectors hold byte offsets of 32 bits.
    if (std::max(m_samples.size(), m_exchanged.size()) > std::size_t(1) << 30)
        throw task::Error(task::ErrorCode::usage,
                          task::because::inWords("the ray sum takes at most 2^30 samples"));
    tbb::parallel_for(0, n.j, [&](int j) {
        std::vector<float> buffer(std::size_t(n.i));
        for (int k = 0; k < n.k; ++k) {
            const float *const row = field.row({0, j, k}, n.i, buffer.data());
            for (int i = 0; i < n.i; ++i) {
                const auto value = std::int16_t(std::lround(double(row[i]) * largestValue));
                m_samples[std::size_t(m_first + k * m_planeStride + j * m_rowStride + i)] = value;
                m_exchanged[std::size_t(m_exchangedFirst + i * m_exchangedPlaneStride +
                                        j * m_exchangedRowStride + k)] = value;
            }
        }
    });
}

SpatialImage raySum(const SpatialVolume &volume, const scene::Camera &camera, double stepMm) {
    const volume::Lattice &lattice = volume.lattice();
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3 corner =
        inVoxels(lattice, camera.panMm.x * axes[0] + camera.panMm.y * axes[1] -
                              0.5 * (camera.width - 1) * camera.pixelMm * axes[0] +
                              0.5 * (camera.height - 1) * camera.pixelMm * axes[1]);
    const glm::dvec3 column = inVoxels(lattice, camera.pixelMm * axes[0]);
    const glm::dvec3 row = inVoxels(lattice, -camera.pixelMm * axes[1]);
    const glm::dvec3 step = inVoxels(lattice, stepMm * axes[2]);
    const volume::GridSize n = lattice.size();
    const std::array<int, 3> size{n.i, n.j, n.k};
    RayJob job;
    job.samples = volume.samples() - volume.planeStride() - volume.rowStride() - 1;
    job.rowStride = volume.rowStride();
    job.planeStride = volume.planeStride();
    for (int axis = 0; axis < 3; ++axis) {
        job.first[axis] = corner[axis] + 0.5 * (size[axis] - 1) + 1.0;
        job.perColumn[axis] = column[axis];
        job.perRow[axis] = row[axis];
        job.step[axis] = float(step[axis]);
        job.end[axis] = float(size[axis] + 1);
    }
    job.width = camera.width;
    job.height = camera.height;
    job.farthest = int(lattice.radiusMm() / stepMm + camera.pixelMm * camera.width / stepMm) + 4;
    // The weights of the two neighbours along x are in 1/16384.
    job.scale = float(stepMm / (16384.0 * SpatialVolume::largestValue));
    SpatialImage image{std::vector<float>(std::size_t(camera.width) * camera.height), camera.width,
                       camera.height, 0};
    std::atomic<std::size_t> count{0};
    const auto tiles = [](int pixels) { return (pixels + rayTile - 1) / rayTile; };
    tbb::parallel_for(tbb::blocked_range2d<int>(0, tiles(camera.height), 0, tiles(camera.width)),
                      [&](const tbb::blocked_range2d<int> &range) {
                          std::size_t taken = 0;
                          for (int y = range.rows().begin(); y != range.rows().end(); ++y)
                              for (int x = range.cols().begin(); x != range.cols().end(); ++x)
                                  castRayTile(job, x * rayTile, y * rayTile, image.samples.data(),
                                              taken);
                          count += taken;
                      });
    image.sampleCount = count;
    return image;
}

SpatialImage shearWarpSum(const SpatialVolume &volume, const scene::Camera &camera) {
    return ShearWarp(volume, inVoxels(volume.lattice(), camera.axes()[2])).sum();
}

} // namespace pellucid::bench
