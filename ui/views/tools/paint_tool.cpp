// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/paint_tool.h"

#include <cmath>
#include <utility>

#include <QGuiApplication>
#include <QPainter>
#include <QPainterPath>

#include <glm/geometric.hpp>

#include "ui/document/document.h"
#include "ui/document/region_commands.h"

namespace pellucid::ui {

namespace {

// Closer points of a path add nothing to see.
constexpr double minShareOfRadius = 0.2;
constexpr int strokeAlpha = 110;

} // namespace

bool PaintTool::press(const QPointF &at) {
    if (!m_document.volume() || m_document.isPreview())
        return false;
    const RegionOptions &options = m_document.marking().options();
    const bool isOther = (QGuiApplication::keyboardModifiers() & Qt::ShiftModifier) != 0;
    m_new = {{}, options.ballMm, options.erases != isOther};
    m_strokes.clear();
    m_isInterrupted = true;
    add(at);
    return isBusy();
}

// Beside the patient the stroke ends; and it does not go through the patient from one depth to
// another.
void PaintTool::add(const QPointF &at) {
    m_hovered = at;
    const auto point = regionPoint(m_document, m_pane, m_view, at);
    if (!point) {
        m_isInterrupted = true;
        return;
    }
    if (!m_isInterrupted) {
        const glm::dvec3 way =
            point->mm - m_strokes.back().path[m_strokes.back().path.size() - 1].mm;
        const double depth = glm::dot(way, m_pane.mapping().plane.axes.toViewer());
        m_isInterrupted = std::abs(depth) > 2.0 * m_new.radiusMm;
        if (!m_isInterrupted && glm::length(way) < minShareOfRadius * m_new.radiusMm)
            return;
    }
    if (m_isInterrupted) {
        if (m_strokes.size() >= classify::maxStrokes)
            return;
        m_strokes.push_back(m_new);
        m_isInterrupted = false;
    }
    if (m_strokes.back().path.size() < classify::maxPoints)
        m_strokes.back().path.push_back(*point);
}

bool PaintTool::move(const MouseMove &mouse) {
    if (!isBusy())
        return false;
    add(mouse.at);
    return true;
}

void PaintTool::release(const QPointF &at) {
    if (!isBusy())
        return;
    add(at);
    useStrokes(m_document, std::exchange(m_strokes, {}));
}

bool PaintTool::hover(const QPointF &at) {
    m_hovered = at;
    return true;
}

void PaintTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    if (marks != Marks::chosen)
        return;
    const double pixels = surface.mapping.pixelsPerMm();
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    if (isBusy()) {
        QColor color = m_new.erases ? surface.colors.warning : surface.colors.accent;
        color.setAlpha(strokeAlpha);
        painter.setPen(
            QPen(color, 2.0 * pixels * m_new.radiusMm, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.setBrush(Qt::NoBrush);
        for (const classify::Stroke &stroke : m_strokes) {
            QPainterPath path(surface.mapping.positionOf(stroke.path[0]));
            for (const volume::PatientPoint &point : stroke.path)
                path.lineTo(surface.mapping.positionOf(point));
            // A path of one point has no length to draw.
            path.lineTo(path.currentPosition() + QPointF(0.01, 0.0));
            painter.drawPath(path);
        }
    }
    if (m_hovered) {
        const double radius = pixels * m_document.marking().options().ballMm;
        painter.setPen(QPen(surface.colors.accent, 1.5));
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(*m_hovered, radius, radius);
    }
    painter.restore();
}

} // namespace pellucid::ui
