// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/decoder/instance.h"
#include "core/dicom/catalogue.h"

namespace pellucid::dicom {

using decoder::FrameHeader;
using decoder::InstanceHeader;
using decoder::Rescale;

/// A frame together with where it comes from.
struct PlacedFrame {
    FrameReference reference;
    FrameHeader header;
    int rows = 0, columns = 0;
    int instanceNumber = 0;
    int framesOfFile = 1;
    std::string sopInstanceUid;
    bool sharesUid = false; ///< another image has its instance UID
    /// Frames of one volume share them: positions of one space, values of one kind.
    std::string frameOfReferenceUid, modality;

    /// Position along the normal of the block it belongs to, mm; one normal for the whole block,
    /// because axes that differ in their last digit would move a distant image by many slices'
    /// tolerance.
    double depthMm = 0.0;
};

struct StackResult {
    StackGeometry geometry;
    std::vector<volume::SliceRange> filled; ///< slices of the lattice inside a hole
    std::vector<task::Reason> warnings;
    /// Set if the frames make no volume.
    std::optional<task::Reason> refusal;
};

/// The largest distance of a slice from its place on an even grid: positions are often written with
/// one decimal. *Units*: mm.
double evennessToleranceMm(double spacingMm);

/// Axes and pixel spacings of two images of one stack may differ by this much, in radians and
/// relatively: against their mean, less than half a pixel at the edge of 512. The volume has a
/// warning if an axis deviates from the mean by `jitterToReport`, or if two spacings differ by it.
inline constexpr double largestJitter = 3e-3, jitterToReport = 1e-3;

/// Sets the depths along the frames' mean normal and sorts by them. Every frame needs a position
/// and an orientation.
void sortByDepth(std::vector<PlacedFrame> &frames);

/// Ranges [first, last) of sorted frames between holes; a hole is a gap of more than 2.5 times the
/// median. One range if there is none.
std::vector<std::pair<std::size_t, std::size_t>> runsOf(const std::vector<PlacedFrame> &frames);

/// The lattice of frames that are sorted by depth and share size, and orientation and pixel spacing
/// up to `largestJitter`. Spacing and tilt come from the positions alone, by least squares.
/// Missing slices are interpolated linearly. Uneven distances are resampled onto the smallest gap
/// that occurs more than once, on a grid through the longest run of such gaps, with a warning that
/// names the files where the distance changes.
StackResult stackGeometry(const std::vector<PlacedFrame> &frames);

/// Whether a warning is one of those of `stackGeometry`.
bool isOfStack(const task::Reason &warning);

} // namespace pellucid::dicom
