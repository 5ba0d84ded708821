// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/paint_tool.h"

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
constexpr double leastShareOfRadius = 0.2;
constexpr int strokeAlpha = 110;

} // namespace

bool PaintTool::press(const QPointF &at) {
    if (!m_document.volume() || m_document.isPreview())
        return false;
    const RegionOptions &options = m_document.marking().options();
    const bool isOther = (QGuiApplication::keyboardModifiers() & Qt::ShiftModifier) != 0;
    m_stroke = {{}, options.ballMm, options.erases != isOther};
    add(at);
    return isBusy();
}

void PaintTool::add(const QPointF &at) {
    m_hovered = at;
    const auto point = regionPoint(m_document, m_pane, m_view, at);
    if (!point || m_stroke.path.size() >= classify::maxPoints)
        return;
    const bool isFar =
        m_stroke.path.empty() || glm::length(point->mm - m_stroke.path.back().mm) >=
                                     leastShareOfRadius * m_stroke.radiusMm;
    if (isFar)
        m_stroke.path.push_back(*point);
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
    useStroke(m_document, std::exchange(m_stroke, {}));
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
        QColor color = m_stroke.erases ? surface.colors.warning : surface.colors.accent;
        color.setAlpha(strokeAlpha);
        QPainterPath path(surface.mapping.positionOf(m_stroke.path.front()));
        for (const volume::PatientPoint &point : m_stroke.path)
            path.lineTo(surface.mapping.positionOf(point));
        // A path of one point has no length to draw.
        path.lineTo(path.currentPosition() + QPointF(0.01, 0.0));
        painter.setPen(QPen(color, 2.0 * pixels * m_stroke.radiusMm, Qt::SolidLine, Qt::RoundCap,
                            Qt::RoundJoin));
        painter.setBrush(Qt::NoBrush);
        painter.drawPath(path);
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
