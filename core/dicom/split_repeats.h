// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// Frames that make one volume, and what distinguishes them from the rest of their stack.
struct Part {
    std::vector<task::Reason> label;
    std::vector<PlacedFrame> frames;
};

/// Whether several frames have the same position. *Shape*: sorted by depth.
bool hasRepeatedPositions(const std::vector<PlacedFrame> &sorted);

/// Splits a stack with repeated positions into parts that have each position once. Uses the first
/// attribute that separates them (temporal position, acquisition, echo, b-value, ...), or nearly
/// does so if slices are missing; otherwise the order of the files. *Shape*: sorted by depth.
/// *Throws* Cancelled.
std::vector<Part> splitRepeats(const std::vector<PlacedFrame> &sorted,
                               const task::Progress &progress);

} // namespace pellucid::dicom
