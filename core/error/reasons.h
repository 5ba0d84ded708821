// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(noMemoryForTheCheck, "not enough memory to measure the error of a picture")
// clang-format on

} // namespace pellucid::task::because
