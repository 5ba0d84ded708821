// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/projection_tools.h"

#include <QGuiApplication>

namespace pellucid::ui {

ProjectionTools::ProjectionTools(Document &document, ProjectionPane &pane)
    : m_pane(pane), m_measure(document, pane, MeasureTool::Figures::inPicture), m_orbit(pane),
      m_pan(pane, Qt::SizeAllCursor), m_zoom(pane), m_tone(document, pane),
      m_grow(document, pane, PaneView::projection), m_paint(document, pane, PaneView::projection),
      m_lasso(document, pane) {}

void ProjectionTools::choose(Tool tool) {
    cancel();
    const auto kind = measuredBy(tool);
    m_measures = kind && !measure::isRegion(*kind);
    m_region = tool == Tool::connected  ? static_cast<PaneTool *>(&m_grow)
               : tool == Tool::paint    ? static_cast<PaneTool *>(&m_paint)
               : tool == Tool::scissors ? static_cast<PaneTool *>(&m_lasso)
                                        : nullptr;
    m_left = tool == Tool::pan    ? static_cast<PaneTool *>(&m_pan)
             : tool == Tool::zoom ? static_cast<PaneTool *>(&m_zoom)
                                  : &m_orbit;
    m_measure.setKind(m_measures ? kind : std::nullopt);
}

std::optional<Qt::CursorShape> ProjectionTools::cursor() const {
    if (m_region != nullptr)
        return m_region->cursor();
    if (m_left != &m_orbit)
        return m_left->cursor();
    return m_measures ? std::optional(m_measure.cursor()) : std::nullopt;
}

Qt::CursorShape ProjectionTools::heldCursor() const {
    return m_activeTool != nullptr ? m_activeTool->cursor() : Qt::ArrowCursor;
}

PaneTool *ProjectionTools::toolOf(Qt::MouseButton button) {
    const bool turns = (QGuiApplication::keyboardModifiers() & Qt::ControlModifier) != 0;
    switch (button) {
    case Qt::LeftButton:
        return turns ? &m_orbit : m_left;
    case Qt::MiddleButton:
        return &m_pan;
    case Qt::RightButton:
        return &m_tone;
    default:
        return nullptr;
    }
}

void ProjectionTools::press(Qt::MouseButton button, const QPointF &at) {
    if (m_measure.isBusy()) { // a figure of several clicks
        if (button == Qt::LeftButton)
            m_measure.press(at);
        return;
    }
    if (isMarking())
        return;
    m_activeTool = nullptr;
    m_last = at.toPoint();
    if (button == Qt::LeftButton && m_pane.showsPicture()) {
        // Ctrl turns the view with any tool.
        const bool turns = (QGuiApplication::keyboardModifiers() & Qt::ControlModifier) != 0;
        const bool isOnMeasurement = m_showsMeasurements && m_measure.gripCursor(at);
        const bool marks = m_region != nullptr && !turns && !isOnMeasurement;
        if (marks) {
            m_region->press(at);
            return; // a click beside the patient does not turn the view
        }
        if (!turns && (m_measures || isOnMeasurement) && m_measure.press(at))
            return;
    }
    m_activeTool = toolOf(button);
    if (m_activeTool != nullptr)
        m_activeTool->press(at);
}

void ProjectionTools::move(const QPointF &at) {
    const MouseMove mouse{at, at.toPoint() - m_last};
    m_last = at.toPoint();
    if (m_region != nullptr && m_region->isBusy())
        m_region->move(mouse);
    else if (m_measure.isBusy())
        m_measure.move(mouse);
    else if (m_activeTool != nullptr && m_pane.canMove() && !mouse.delta.isNull())
        m_activeTool->move(mouse);
}

void ProjectionTools::release(Qt::MouseButton button, const QPointF &at) {
    if (button == Qt::LeftButton && m_region != nullptr && m_region->isBusy())
        m_region->release(at);
    else if (m_measure.isBusy() && button == Qt::LeftButton)
        m_measure.release(at);
    m_activeTool = nullptr;
}

bool ProjectionTools::hover(const QPointF &at) {
    return m_region != nullptr && m_activeTool == nullptr && m_region->hover(at);
}

void ProjectionTools::leave() {
    if (m_region != nullptr)
        m_region->leave();
}

bool ProjectionTools::isMarking() const {
    return m_measure.isBusy() || (m_region != nullptr && m_region->isBusy());
}

bool ProjectionTools::doublePress(const QPointF &at) {
    return m_pane.showsPicture() && (m_showsMeasurements || m_measure.isBusy()) &&
           m_measure.doublePress(at);
}

bool ProjectionTools::finishFigure() {
    return m_measure.finishPolyline();
}

int ProjectionTools::measurementAt(const QPointF &at) const {
    return m_pane.showsPicture() && m_showsMeasurements ? m_measure.at(at) : -1;
}

void ProjectionTools::cancel() {
    m_measure.cancel();
    if (m_region != nullptr)
        m_region->cancel();
}

void ProjectionTools::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    m_measure.paint(painter, surface, marks);
    if (m_region != nullptr && marks > Marks::plain)
        m_region->paint(painter, surface, Marks::chosen);
}

} // namespace pellucid::ui
