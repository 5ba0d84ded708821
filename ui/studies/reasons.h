// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Files and folders
PELLUCID_REASON(isGone, "no longer exists")

// The study library
PELLUCID_REASON(volumeHasChanged, "the files of this volume have changed; import them again")
PELLUCID_REASON(seriesIsGone, "the files of this series cannot be found; the disc or drive they are on may be disconnected")
// clang-format on

} // namespace pellucid::task::because
