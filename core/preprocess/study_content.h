// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/presets/study_traits.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

/// What a study shows: the regions that its header names; if it names none, and for contrast medium
/// always, what CT values show. Head, chest and abdomen are told by each slice's area, bone and
/// lung; contrast medium is 8 ml or more of even values from 150 to 600 HU that are not in bone.
/// Found in means of 3 mm. *Throws* Error{outOfMemory}, Error{internal}, Cancelled.
presets::StudyTraits traitsOf(const volume::Volume &volume, const task::Progress &progress = {});

} // namespace pellucid::preprocess
