// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/presets/study_traits.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

struct StudyContent {
    presets::StudyTraits traits;
    /// Whether a CT scan contains a couch, a head rest or the like: at least 30 ml above air that
    /// do not belong to the patient.
    bool hasCouch = false;
};

/// Finds out what a study shows. Regions come from the header, or, if it names none, from the
/// values of CT: head, chest and abdomen differ in area, bone and lung of their slices. Contrast
/// medium is found by value: at least 8 ml of 150 to 600 HU outside bone, in parts that are as
/// uniform as blood. Searches means of 3 mm. *Throws* Error{outOfMemory}, Error{internal},
/// Cancelled.
StudyContent contentOf(const volume::Volume &volume, const task::Progress &progress = {});

} // namespace pellucid::preprocess
