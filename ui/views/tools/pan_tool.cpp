// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/pan_tool.h"

namespace pellucid::ui {

bool PanTool::move(const HandMove &hand) {
    m_pane.panBy(hand.delta);
    return true;
}

} // namespace pellucid::ui
