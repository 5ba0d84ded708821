// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// Splits an uneven stack whose positions do not repeat into parts that overlap each other, each of
/// which is an even stack: two scans of the same region. Empty if there are none. *Shape*: sorted
/// by depth. *Throws* Cancelled.
std::vector<Part> splitOverlapping(const std::vector<PlacedFrame> &sorted,
                                   const ReadAttributes &read, const task::Progress &progress);

} // namespace pellucid::dicom
