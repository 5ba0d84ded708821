// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "gpu/capabilities.h"

namespace pellucid::ui {

/// The capabilities of OpenGL in windows; none if there is no OpenGL. Probed once.
const std::optional<gpu::Capabilities> &windowCapabilities();

} // namespace pellucid::ui
