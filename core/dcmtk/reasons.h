// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(jpeg2000EncodingFailed, "JPEG 2000 encoding failed")
// clang-format on

} // namespace pellucid::task::because
