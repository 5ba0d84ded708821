// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/orbit_tool.h"

namespace pellucid::ui {

bool OrbitTool::move(const HandMove &hand) {
    m_pane.orbitBy(hand.delta);
    return true;
}

} // namespace pellucid::ui
