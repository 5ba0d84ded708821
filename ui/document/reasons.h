// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Measurements
PELLUCID_REASON(measurementsCannotBeRead, "The measurements of this study cannot be read: %1")
PELLUCID_REASON(measurementsCannotBeKept, "The measurements cannot be saved: %1")
PELLUCID_REASON(noFolderForMeasurements, "The measurements cannot be saved: there is no folder for them")
PELLUCID_REASON(formerMeasurementsUnreadable, "the earlier ones cannot be read and would be lost")

// The window
PELLUCID_REASON(noStudyIsOpen, "no study is open")
PELLUCID_REASON(isOfAnOpenStudy, "%1 belongs to an open study; choose another name")
// clang-format on

} // namespace pellucid::task::because
