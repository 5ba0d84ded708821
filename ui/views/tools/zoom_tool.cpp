// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/zoom_tool.h"

#include <cmath>

namespace pellucid::ui {

bool ZoomTool::move(const MouseMove &mouse) {
    m_pane.zoomBy(std::exp(-0.008 * mouse.delta.y()));
    return true;
}

} // namespace pellucid::ui
