// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(manualIsNotInstalled, "the manual is not installed")
PELLUCID_REASON(noBrowserForTheManual, "no web browser is set up to open the manual")
// clang-format on

} // namespace pellucid::task::because
