// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::ui {

/// What the left mouse button does in the MPR panes.
enum class Tool { window, pan, zoom, crosshair };

} // namespace pellucid::ui
