// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "gpu/capabilities.h"

namespace pellucid::ui {

/// What OpenGL gives windows here; nothing if there is none. Found out once.
const std::optional<gpu::Capabilities> &windowCapabilities();

} // namespace pellucid::ui
