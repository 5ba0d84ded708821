// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/projection_tools.h"

namespace pellucid::ui {

ProjectionTools::ProjectionTools(Document &document, ProjectionPane &pane)
    : m_pane(pane), m_measure(document, pane, MeasureTool::Figures::inPicture), m_orbit(pane),
      m_pan(pane, Qt::SizeAllCursor), m_tone(document, pane) {}

void ProjectionTools::choose(Tool tool) {
    m_measures = tool == Tool::distance;
    m_measure.cancel();
    m_measure.setKind(m_measures ? std::optional(measure::Kind::projectedDistance) : std::nullopt);
}

std::optional<Qt::CursorShape> ProjectionTools::cursor() const {
    return m_measures ? std::optional(m_measure.cursor()) : std::nullopt;
}

Qt::CursorShape ProjectionTools::heldCursor() const {
    return m_activeTool != nullptr ? m_activeTool->cursor() : Qt::ArrowCursor;
}

PaneTool *ProjectionTools::toolOf(Qt::MouseButton button) {
    switch (button) {
    case Qt::LeftButton:
        return &m_orbit;
    case Qt::MiddleButton:
        return &m_pan;
    case Qt::RightButton:
        return &m_tone;
    default:
        return nullptr;
    }
}

void ProjectionTools::press(Qt::MouseButton button, const QPointF &at) {
    if (m_measure.isBusy())
        return;
    m_activeTool = nullptr;
    m_last = at.toPoint();
    if (button == Qt::LeftButton && m_pane.showsPicture() && m_measure.press(at))
        return;
    m_activeTool = toolOf(button);
    if (m_activeTool != nullptr)
        m_activeTool->press(at);
}

void ProjectionTools::move(const QPointF &at) {
    const MouseMove mouse{at, at.toPoint() - m_last};
    m_last = at.toPoint();
    if (m_measure.isBusy())
        m_measure.move(mouse);
    else if (m_activeTool != nullptr && m_pane.canMove() && !mouse.delta.isNull())
        m_activeTool->move(mouse);
}

void ProjectionTools::release(Qt::MouseButton button, const QPointF &at) {
    if (m_measure.isBusy() && button == Qt::LeftButton)
        m_measure.release(at);
    m_activeTool = nullptr;
}

} // namespace pellucid::ui
