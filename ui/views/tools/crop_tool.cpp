// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/crop_tool.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QPainter>
#include <QPainterPath>

#include "ui/document/commands.h"
#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

constexpr double grabPixels = 7.0; // logical pixels
constexpr int outsideAlpha = 130;

QPointF position(const PaneMapping &mapping, const glm::dvec2 &pixel) {
    return QPointF(pixel.x + 0.5, pixel.y + 0.5) / mapping.pixelRatio;
}

QPointF inside(const QRect &area, const QPointF &p) {
    const QRectF seen = QRectF(area).adjusted(1.5, 4.5, -1.5, -1.5); // below the color bar
    return {std::clamp(p.x(), seen.left(), seen.right()),
            std::clamp(p.y(), seen.top(), seen.bottom())};
}

double distance(const QPointF &p, const QPointF &a, const QPointF &b) {
    const QPointF along = b - a;
    const double length2 = QPointF::dotProduct(along, along);
    const double t =
        length2 > 0.0 ? std::clamp(QPointF::dotProduct(p - a, along) / length2, 0.0, 1.0) : 0.0;
    const QPointF off = p - (a + t * along);
    return std::hypot(off.x(), off.y());
}

// Fractions 0 and 1 are the outer faces of the first and last samples.
mpr::LatticeBox latticeBox(const classify::CropBox &box, const volume::GridSize &size) {
    const glm::dvec3 n(size.i, size.j, size.k);
    return {box.low * n - 0.5, box.high * n - 0.5};
}

} // namespace

const classify::CropBox &CropTool::shown() const {
    return m_dragged ? m_moved : m_document.scene().crop;
}

std::vector<mpr::BoxEdge> CropTool::outline(const PaneMapping &mapping) const {
    const volume::Lattice &lattice = m_document.volume()->lattice();
    return mpr::boxOutline(lattice, latticeBox(shown(), lattice.size()), mapping.plane);
}

std::optional<mpr::BoxEdge> CropTool::edgeAt(const QPointF &at) const {
    const PaneMapping mapping = m_pane.mapping();
    std::optional<mpr::BoxEdge> nearest;
    double nearestDistance = grabPixels;
    for (const mpr::BoxEdge &edge : outline(mapping)) {
        const double d = distance(at, position(mapping, edge.from), position(mapping, edge.to));
        if (edge.axis >= 0 && d < nearestDistance) {
            nearestDistance = d;
            nearest = edge;
        }
    }
    return nearest;
}

std::optional<Qt::CursorShape> CropTool::gripCursor(const QPointF &at) const {
    const auto edge = edgeAt(at);
    if (!edge)
        return std::nullopt;
    const glm::dvec2 along = edge->to - edge->from;
    return std::abs(along.x) > std::abs(along.y) ? Qt::SizeVerCursor : Qt::SizeHorCursor;
}

bool CropTool::press(const QPointF &at) {
    const auto edge = edgeAt(at);
    if (!edge)
        return false;
    m_moved = m_document.scene().crop;
    m_dragged = Face{edge->axis, edge->isHigh};
    return true;
}

bool CropTool::move(const MouseMove &mouse) {
    if (!m_dragged)
        return false;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    const int axis = m_dragged->axis, count = lattice.size()[axis];
    // Faces are between samples.
    const double voxel = lattice.voxel(m_pane.mapping().patientAt(mouse.at)).v[axis];
    const double share = std::clamp(std::round(voxel + 0.5), 0.0, double(count)) / count;
    const double one = 1.0 / count;
    if (m_dragged->isHigh)
        m_moved.high[axis] = std::max(share, m_moved.low[axis] + one);
    else
        m_moved.low[axis] = std::min(share, m_moved.high[axis] - one);
    return true;
}

void CropTool::release(const QPointF & /*at*/) {
    if (!m_dragged)
        return;
    m_dragged.reset();
    editScene(m_document, QCoreApplication::translate("CropTool", "Crop"), noDrag,
              [this](scene::Scene &scene) { scene.crop = m_moved; });
}

void CropTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    const bool isWhole = shown().isWhole();
    if (marks <= Marks::plain || (isWhole && marks != Marks::chosen))
        return;
    const auto edges = outline(surface.mapping);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    if (!isWhole) {
        QPainterPath outside;
        outside.addRect(surface.area);
        QPolygonF inside;
        for (const mpr::BoxEdge &edge : edges)
            inside << position(surface.mapping, edge.from);
        if (!inside.isEmpty()) {
            QPainterPath hole;
            hole.addPolygon(inside);
            hole.closeSubpath();
            outside = outside.subtracted(hole);
        }
        painter.fillPath(outside, QColor(0, 0, 0, outsideAlpha));
    }
    paintSides(painter, surface, edges, marks);
    painter.restore();
}

void CropTool::paintSides(QPainter &painter, const ToolSurface &surface,
                          const std::vector<mpr::BoxEdge> &edges, Marks marks) const {
    const bool isDraggable = marks == Marks::chosen;
    for (const mpr::BoxEdge &edge : edges) {
        if (edge.axis < 0)
            continue;
        const bool isDragged =
            m_dragged && m_dragged->axis == edge.axis && m_dragged->isHigh == edge.isHigh;
        painter.setPen(QPen(surface.colors.accent, isDragged ? 2.5 : isDraggable ? 1.5 : 1.0));
        // If the volume fills the pane, the sides are drawn at its border.
        const QPointF from = inside(surface.area, position(surface.mapping, edge.from)),
                      to = inside(surface.area, position(surface.mapping, edge.to));
        painter.drawLine(from, to);
        if (isDraggable) {
            painter.setBrush(surface.colors.accent);
            painter.drawEllipse(0.5 * (from + to), 3.5, 3.5);
        }
    }
}

} // namespace pellucid::ui
