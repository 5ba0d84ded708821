// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/orbit_tool.h"

namespace pellucid::ui {

bool OrbitTool::move(const MouseMove &mouse) {
    m_pane.orbitBy(mouse.delta);
    return true;
}

} // namespace pellucid::ui
