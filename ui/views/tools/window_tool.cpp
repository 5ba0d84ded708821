// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/window_tool.h"

#include <algorithm>
#include <cmath>

#include "ui/document/document.h"

namespace pellucid::ui {

bool WindowTool::press(const QPointF & /*at*/) {
    m_drag = nextDragId();
    return true;
}

bool WindowTool::move(const MouseMove &mouse) {
    // A drag across a typical pane changes the window by about its own width, so that narrow and
    // wide windows are equally easy to set.
    volume::ValueWindow window = m_document.displayWindow();
    const double perPixel = std::max(window.width, 1e-6) / 250.0;
    window.width = std::max(window.width + mouse.delta.x() * perPixel,
                            1e-3 * std::max(1.0, std::abs(window.width)));
    window.center -= mouse.delta.y() * perPixel;
    window.name.clear();
    m_document.undoStack()->push(new EditDisplayWindow(m_document, window, m_drag));
    return true;
}

} // namespace pellucid::ui
