// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/catalogue.h"
#include "core/dicom/frame_groups.h"

namespace pellucid::dicom {

/// The entries of a part: its stack; or, if slices are missing or the field of view shifts, the
/// runs between; and in the first case also the whole stack with its holes filled. Frames that form
/// no stack become a set of images that contains the reason. *Shape*: sorted by depth, not empty.
std::vector<VolumeEntry> volumesOf(const Part &part, Slices slices);

/// An entry of images without a common geometry: slices 1 mm apart, shown one by one.
VolumeEntry imagesOf(const Part &part, const task::Reason &reason);

} // namespace pellucid::dicom
