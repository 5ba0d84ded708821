// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// Frames that make one volume, and what tells them from the others of their stack.
struct Part {
    std::vector<task::Reason> label;
    std::vector<PlacedFrame> frames;
};

/// Whether several frames have one place. *Shape*: sorted by depth.
bool placesRepeat(const std::vector<PlacedFrame> &sorted);

/// Splits a stack whose places repeat into parts that have each place once: by the first attribute
/// that tells them apart (temporal position, acquisition, echo, b-value, ...), or, if slices are
/// missing, nearly does; at last by the order of the files. *Shape*: sorted by depth. *Throws*
/// Cancelled.
std::vector<Part> splitRepeats(const std::vector<PlacedFrame> &sorted,
                               const task::Progress &progress);

} // namespace pellucid::dicom
