// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(isNoKernel, "unknown kernel '%1': use nearest, trilinear, catmull-rom, b-spline, hamming-sinc, ES2 to ES7, KB2 to KB7 or LS2 to LS7")
// clang-format on

} // namespace pellucid::task::because
