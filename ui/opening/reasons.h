// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Segmentations
PELLUCID_REASON(tooManyClassesToAdd, "segments are left out: a look has at most %1 classes")
PELLUCID_REASON(sceneNeedsSegments, "needs segments that are not loaded: %1")

// The study library, sessions and export
PELLUCID_REASON(isNoSession, "is not a session file")
PELLUCID_REASON(isAnotherStudy, "is not the study of the last session")
// clang-format on

} // namespace pellucid::task::because
