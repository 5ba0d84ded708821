// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/camera.h"
#include "core/volume/field.h"

namespace pellucid::bench {

/// A field in the format of the spatial methods: 12 significant bits in int16, with readable zeros
/// between rows and planes.
class SpatialVolume {
public:
    static constexpr int largestValue = 4095;

    /// *Units*: the field is 0..1.
    explicit SpatialVolume(const volume::Field &field);

    const volume::Lattice &lattice() const { return m_lattice; }
    /// The sample (0,0,0). `gap` zeros follow each row, a row of zeros each plane. Zeros also
    /// precede the first row (a plane, a row and a gap) and follow the last (two planes and a row).
    const std::int16_t *samples() const { return m_samples.data() + m_first; }
    std::ptrdiff_t rowStride() const { return m_rowStride; }
    std::ptrdiff_t planeStride() const { return m_planeStride; }
    /// The same with the first and the last axis exchanged.
    const std::int16_t *exchanged() const { return m_exchanged.data() + m_exchangedFirst; }
    std::ptrdiff_t exchangedRowStride() const { return m_exchangedRowStride; }
    std::ptrdiff_t exchangedPlaneStride() const { return m_exchangedPlaneStride; }

    static constexpr std::ptrdiff_t gap = 64;

private:
    volume::Lattice m_lattice;
    std::vector<std::int16_t> m_samples, m_exchanged;
    std::ptrdiff_t m_first = 0, m_rowStride = 0, m_planeStride = 0;
    std::ptrdiff_t m_exchangedFirst = 0, m_exchangedRowStride = 0, m_exchangedPlaneStride = 0;
};

/// The image of a spatial method.
struct SpatialImage {
    std::vector<float> samples; ///< *Units*: field times mm
    int width = 0, height = 0;
    std::size_t sampleCount = 0; ///< trilinear samples taken
};

/// Ray casting that only adds: parallel rays through the pixel centres, one trilinear sample every
/// `stepMm`, on all threads of oneTBB. Vectorised over 16 neighbouring rays, in tiles that advance
/// slab by slab, so that a tile's part of the volume stays in the cache.
SpatialImage raySum(const SpatialVolume &volume, const scene::Camera &camera, double stepMm);

/// The accumulation step of the shear-warp factorisation (Lacroute and Levoy 1994) without the
/// warp: each slice across the principal axis is shifted by a fraction of a voxel and added, one
/// bilinear sample per voxel, on all threads of oneTBB. *Units*: field times voxels along the
/// principal axis.
SpatialImage shearWarpSum(const SpatialVolume &volume, const scene::Camera &camera);

} // namespace pellucid::bench
