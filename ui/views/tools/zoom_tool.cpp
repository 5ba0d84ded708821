// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/zoom_tool.h"

#include <cmath>

namespace pellucid::ui {

bool ZoomTool::move(const HandMove &hand) {
    m_pane.zoomBy(std::exp(-0.008 * hand.delta.y()));
    return true;
}

} // namespace pellucid::ui
