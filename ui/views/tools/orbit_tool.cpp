// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/orbit_tool.h"

#include <cmath>

#include <QGuiApplication>
#include <QRectF>

namespace pellucid::ui {

bool OrbitTool::move(const MouseMove &mouse) {
    // Some window managers move the window by Alt and the mouse.
    if ((QGuiApplication::keyboardModifiers() & (Qt::AltModifier | Qt::ShiftModifier)) == 0) {
        m_projection.orbitBy(mouse.delta);
        return true;
    }
    // About the middle of the pane, as far as the hand turns.
    const QPointF middle = QRectF({}, QSizeF(m_pane.paneSize())).center();
    const QPointF now = mouse.at - middle, before = now - mouse.delta;
    m_projection.rollBy(std::atan2(before.x() * now.y() - before.y() * now.x(),
                                   before.x() * now.x() + before.y() * now.y()));
    return true;
}

} // namespace pellucid::ui
