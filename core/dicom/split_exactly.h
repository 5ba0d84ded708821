// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// Splits all frames so that each group has each position once, by an attribute or several
/// together. The values of an attribute either equal each other throughout a group, or drift from
/// slice to slice by less than they differ between groups. Empty if there is no such split.
/// *Throws* Cancelled.
FrameGroups splitExactly(const RepeatedFrames &frames, const std::vector<Column> &columns);

} // namespace pellucid::dicom
