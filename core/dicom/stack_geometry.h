// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
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
    std::string sopInstanceUid;
    /// Frames of one volume share them: positions of one space, values of one kind.
    std::string frameOfReferenceUid, modality;

    /// Position along the normal of the block it belongs to, mm; one normal for the whole block,
    /// because axes that differ in their last digit would move a distant image by many slices'
    /// tolerance.
    double depthMm = 0.0;
};

struct StackResult {
    StackGeometry geometry;
    std::vector<std::string> warnings;
    /// Set if the frames make no volume.
    std::string refusal;
};

/// Neighbouring slices that differ by less than this from the common distance are evenly spaced.
double spacingToleranceMm(double spacingMm);

/// Sets the depths along the first frame's normal and sorts by them. Every frame needs a position
/// and an orientation.
void sortByDepth(std::vector<PlacedFrame> &frames);

/// The lattice of frames that are sorted by depth and share size, orientation and pixel spacing.
/// Spacing and tilt come from the positions alone. Uneven distances are resampled onto the smallest
/// gap that occurs more than once, with a warning that names the files where the distance changes;
/// a gap of more than 2.5 times the median is refused.
StackResult stackGeometry(const std::vector<PlacedFrame> &frames);

} // namespace pellucid::dicom
