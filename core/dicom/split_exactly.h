// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// How the values of an attribute tell groups apart: equal within a group, or also drifting from
/// slice to slice by less than they differ between groups.
enum class Telling { byValue, alsoByRank };

/// Splits all frames so that each group has each position once, by an attribute or several
/// together. Empty if there is no such split. *Throws* Cancelled.
FrameGroups splitExactly(const RepeatedFrames &frames, const std::vector<Column> &columns,
                         Telling telling);

} // namespace pellucid::dicom
