// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/crosshair_tool.h"

#include <QCoreApplication>
#include <QPainter>
#include <QRegion>

#include <glm/common.hpp>

#include "ui/document/document.h"

namespace pellucid::ui {

CrosshairLines CrosshairTool::lines(const PaneMapping &mapping) const {
    return {mapping, m_document.crosshair(), m_document.cut().axes, m_orientation};
}

std::optional<Qt::CursorShape> CrosshairTool::gripCursor(const QPointF &at) const {
    return lines(m_pane.mapping()).isHandleAt(at, m_pane.paneSize())
               ? std::optional(Qt::PointingHandCursor)
               : std::nullopt;
}

bool CrosshairTool::press(const QPointF &at) {
    const QPoint pressed = at.toPoint();
    const CrosshairLines shown = lines(m_pane.mapping());
    m_isTurning = shown.isHandleAt(pressed, m_pane.paneSize());
    if (m_isTurning) {
        m_turnAngle = shown.angleAt(pressed);
        m_drag = nextDragId();
    } else
        moveTo(pressed);
    return true;
}

bool CrosshairTool::move(const MouseMove &mouse) {
    if (m_isTurning)
        turnTo(mouse.at.toPoint());
    else
        moveTo(mouse.at.toPoint());
    return true;
}

void CrosshairTool::moveTo(const QPoint &to) {
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // Keep the crosshair within the volume, so that every pane shows a slice.
    glm::dvec3 v = lattice.voxel(m_pane.mapping().patientAt(to)).v;
    v = glm::clamp(v, glm::dvec3(0.0),
                   glm::dvec3(lattice.size().i - 1, lattice.size().j - 1, lattice.size().k - 1));
    m_document.setCrosshair(lattice.patient(volume::VoxelPoint{v}));
}

void CrosshairTool::turnTo(const QPoint &to) {
    const double angle = lines(m_pane.mapping()).angleAt(to);
    const mpr::PlaneAxes turned = m_document.cut().axes.turned(m_orientation, angle - m_turnAngle);
    m_turnAngle = angle;
    m_document.undoStack()->push(new EditPlaneAxes(
        m_document, turned, QCoreApplication::translate("Commands", "Turn the planes"), m_drag));
}

void CrosshairTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    if (marks <= Marks::plain)
        return;
    painter.save();
    painter.setClipRegion(QRegion(surface.area) - upperAndLowerLetters(surface.area));
    lines(surface.mapping).paint(painter, surface.area.size(), marks == Marks::chosen);
    painter.restore();
}

} // namespace pellucid::ui
