// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// Splits all frames by image numbers that run part by part, or position by position. Empty if they
/// do neither.
FrameGroups splitByNumber(const RepeatedFrames &frames);

} // namespace pellucid::dicom
