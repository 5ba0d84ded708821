// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// Whether several frames have the same position. *Shape*: sorted by depth.
bool hasRepeatedPositions(const std::vector<PlacedFrame> &sorted);

/// Splits a stack with repeated positions into parts that have each position once, in the order of
/// the values that distinguish them. These are, in this order: the place within the plane, if the
/// parts lie apart; an attribute of `headerColumns` or several together; one that leaves some
/// positions out, where slices are missing; the same of all other attributes, which `read` lists;
/// smaller shifts within the plane; and the image numbers, with a warning, where they run part by
/// part or position by position. Empty if nothing distinguishes the parts. *Shape*: sorted by
/// depth. *Throws* Cancelled.
std::vector<Part> splitRepeats(const std::vector<PlacedFrame> &sorted, const ReadAttributes &read,
                               const task::Progress &progress);

} // namespace pellucid::dicom
