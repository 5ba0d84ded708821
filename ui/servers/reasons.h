// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(keyOfReceiverHasAPassword, "the private key for receiving is protected by a password; use one without")
PELLUCID_REASON(isNoLink, "is not a link that can be opened; use pellucid://open?server=NAME&studyUID=UID")
// clang-format on

} // namespace pellucid::task::because
