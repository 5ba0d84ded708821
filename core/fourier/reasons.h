// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Memory
PELLUCID_REASON(rowsOfATransform, "a transform's rows")
PELLUCID_REASON(aTransform, "a transform")
PELLUCID_REASON(aSpectrum, "a spectrum")

// Scenes, plans and engines
PELLUCID_REASON(isNoStorage, "unknown storage '%1': use f16 or f32")
// clang-format on

} // namespace pellucid::task::because
