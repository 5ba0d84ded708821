// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pellucid::bench {

/// Rays are cast in tiles of this many columns and rows.
inline constexpr int rayTile = 16;

/// A camera's rays. *Units*: voxels, with the origin one voxel before the first, so that no
/// coordinate that is read is negative.
struct RayJob {
    const std::int16_t *samples = nullptr; ///< at the origin, a zero
    std::ptrdiff_t rowStride = 0, planeStride = 0;
    std::array<double, 3> first{}, perColumn{}, perRow{}; ///< sample 0 of a pixel's ray
    std::array<float, 3> step{};                          ///< to the next sample of a ray
    std::array<float, 3> end{}; ///< the last coordinate that is read; samples are 0 there
    int width = 0, height = 0;
    int farthest = 0; ///< no ray has a sample beyond +-this
    float scale = 1.0F;
};
void castRayTile(const RayJob &job, int tileX, int tileY, float *samples, std::size_t &count);

inline constexpr int shearSlices = 8;

/// The contribution of one slice to a row of the sheared image: at x, the bilinear mix of
/// row[x - shift], its left neighbour (weightX) and the same two of the row before (weightY).
struct ShearedSlice {
    const std::int16_t *row = nullptr, *rowBefore = nullptr;
    int shift = 0, width = 0;
    std::int16_t weightX = 0, weightY = 0; ///< in 1/32768
};
struct ShearGroup {
    std::array<ShearedSlice, shearSlices> slices;
    int begin = 0, end = 0; ///< columns that any slice reaches
};
void addShearedSlices(const ShearGroup &group, int width, std::int32_t *row);

} // namespace pellucid::bench
