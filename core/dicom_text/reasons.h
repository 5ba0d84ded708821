// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(dictionaryMissing, "the DICOM data dictionary is missing")
// clang-format on

} // namespace pellucid::task::because
