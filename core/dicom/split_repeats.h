// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/attribute_columns.h"
#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// Frames that make one volume, and what distinguishes them from the rest of their stack.
struct Part {
    std::vector<task::Reason> label;
    std::vector<PlacedFrame> frames;
    std::vector<task::Reason> warnings;
};

/// Whether several frames have the same position. *Shape*: sorted by depth.
bool hasRepeatedPositions(const std::vector<PlacedFrame> &sorted);

/// Splits a stack with repeated positions into parts that have each position once, in the order of
/// the values that distinguish them. These are, in this order: an attribute of `headerColumns` or
/// several together; one that leaves some positions out, where slices are missing; the same of all
/// other attributes, which `read` lists; and the image numbers, with a warning, where they run part
/// by part or position by position. The values of an attribute either equal each other throughout a
/// part, or drift from slice to slice by less than they differ between parts. Empty if nothing
/// distinguishes the parts. *Shape*: sorted by depth. *Throws* Cancelled.
std::vector<Part> splitRepeats(const std::vector<PlacedFrame> &sorted, const ReadAttributes &read,
                               const task::Progress &progress);

/// Splits an uneven stack whose positions do not repeat into parts that overlap each other, each of
/// which is an even stack: two scans of the same region. Empty if there are none. *Shape*: sorted
/// by depth. *Throws* Cancelled.
std::vector<Part> splitOverlapping(const std::vector<PlacedFrame> &sorted,
                                   const ReadAttributes &read, const task::Progress &progress);

} // namespace pellucid::dicom
