// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/decoding/client/instance.h"
#include "core/dicom/catalogue.h"

namespace pellucid::dicom {

using decoding::FrameHeader;
using decoding::InstanceHeader;
using decoding::Rescale;

/// A frame and its source.
struct PlacedFrame {
    FrameReference reference;
    FrameHeader header;
    int rows = 0, columns = 0;
    int instanceNumber = 0;
    int framesOfFile = 1;
    std::string sopInstanceUid;
    bool sharesUid = false; ///< another image has the same instance UID
    int statedValues = 0;   ///< see `dicom::statedValues`
    /// The same for all frames of a volume: one patient space, one kind of values.
    std::string frameOfReferenceUid, modality;

    /// Position along the mean normal of its block, mm. The block has one normal, because axes that
    /// differ in their last digit would move a distant image by many times the slice tolerance.
    double depthMm = 0.0;
    /// Position along the mean row and column axes of its block, mm.
    glm::dvec2 placeMm{0.0};
};

struct StackResult {
    StackGeometry geometry;
    std::vector<volume::SliceRange> filled; ///< slices of the lattice within a hole
    std::vector<task::Reason> warnings;
    /// Set if the frames make no volume.
    std::optional<task::Reason> refusal;
};

/// How much the axes (radians) and pixel spacings (relative) of two images of one stack may differ:
/// relative to the mean, this is less than half a pixel at the edge of 512. The volume gets a
/// warning if an axis deviates from the mean by `jitterToReport`, or two spacings differ by it.
inline constexpr double largestJitter = 3e-3, jitterToReport = 1e-3;

/// How far a frame may be from the line through the positions of its stack, mm: a part of a pixel.
double lineToleranceMm(const glm::dvec2 &spacingMm);

/// Whether two frames of a block have the same position along the normal.
bool sameDepth(const PlacedFrame &a, const PlacedFrame &b);

/// Sets the depths and places along the frames' mean axes and sorts by depth. Every frame needs a
/// position and an orientation.
void sortByDepth(std::vector<PlacedFrame> &frames);

/// Where a stack ends and another begins, between frames `at - 1` and `at`.
struct Break {
    std::size_t at;
    double gapMm;
    double shiftMm; ///< of the field of view; 0: slices are missing
};
/// The breaks of sorted frames: gaps of more than 2.5 times the median; or, if there are none,
/// shifts of the field of view between stacks that are each in line.
std::vector<Break> breaksOf(const std::vector<PlacedFrame> &frames);

/// The lattice of frames that are sorted by depth and have the same size, and the same orientation
/// and pixel spacing within `largestJitter`. Spacing and tilt come from the positions alone, by
/// least squares. Missing slices are interpolated linearly. Uneven stacks are resampled to the
/// smallest gap that occurs more than once, on a grid through the longest run of such gaps, with a
/// warning that names the files where the distance changes.
StackResult stackGeometry(const std::vector<PlacedFrame> &frames, Slices slices = Slices::all);

/// Whether a warning comes from `stackGeometry`.
bool isStackWarning(const task::Reason &warning);

} // namespace pellucid::dicom
