// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/pan_tool.h"

namespace pellucid::ui {

bool PanTool::move(const MouseMove &mouse) {
    m_pane.panBy(mouse.delta);
    return true;
}

} // namespace pellucid::ui
