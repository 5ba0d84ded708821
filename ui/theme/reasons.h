// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(noIcon, "the icon %1 is missing")
PELLUCID_REASON(noResource, "the resource %1 is missing")
PELLUCID_REASON(noColor, "the role %1 has no color")
// clang-format on

} // namespace pellucid::task::because
