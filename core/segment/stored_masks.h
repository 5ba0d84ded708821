// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/task/progress.h"
#include "core/volume/coverage.h"

namespace pellucid::segment {

/// How far a pixel may lie from the sample that it belongs to, in steps of the lattice.
inline constexpr double sampleTolerance = 0.05;

/// A plane of pixels in patient space: pixel (c, r) is at origin + c columnStep + r rowStep.
struct MaskPlane {
    glm::dvec3 origin, columnStep, rowStep; ///< mm
    int segment = 0;                        ///< the index of the segment that it shows
};

/// Masks as files store them, plane by plane.
struct StoredMasks {
    /// A bit for each pixel, the lowest of a byte first, without a gap between rows or planes; or
    /// 16 bits: a fraction, or a label.
    enum class Pixels { bits, fractions, labels };

    Pixels kind = Pixels::bits;
    int columns = 0, rows = 0;     ///< of every plane
    std::vector<MaskPlane> planes; ///< parallel to each other
    double thicknessMm = 0.0;      ///< of a plane, as stated; 0: unknown
    /// Between planes that are farther apart than this times their thickness is a gap.
    double longestGap = 1.5;
    /// *Shape*: planes x rows x columns. Bytes that change while they are read give wrong masks,
    /// but do no harm.
    std::span<const std::byte> pixels;
    int largestFraction = 255; ///< the fraction that means all of a pixel
    int segments = 1;
    std::vector<int> segmentOfLabel; ///< for each 16-bit label the index of its segment, or -1
};

/// Masks on the lattice of a volume.
struct PlacedMasks {
    std::vector<volume::Coverage>
        coverages;            ///< one of each segment; empty if it has no pixels there
    bool isResampled = false; ///< the pixels do not lie on the lattice's samples
};

/// Places masks by their geometry. Where every pixel lies on a sample, within `sampleTolerance`,
/// the sample gets its value, whatever the order and direction of rows, columns and planes.
/// Otherwise the masks are interpolated linearly, but not across gaps; they end half a thickness
/// beyond the outermost planes. *Throws* Error{unusable} if the
/// planes are not parallel, Error{outOfMemory}, Cancelled.
PlacedMasks placed(const StoredMasks &masks, const volume::Lattice &lattice,
                   const task::Progress &progress = {});

/// The largest distance of a pixel within the lattice from the nearest sample, mm. 0 if every one
/// lies on a sample, within `sampleTolerance`. *Throws* Cancelled.
double farthestFromSamplesMm(const StoredMasks &masks, const volume::Lattice &lattice,
                             const task::Progress &progress = {});

} // namespace pellucid::segment
