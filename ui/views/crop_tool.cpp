// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/crop_tool.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QPainter>
#include <QPainterPath>

#include "ui/document/commands.h"
#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

constexpr double reach = 7.0; // of the hand, logical pixels
constexpr int outsideAlpha = 130;

QPointF position(const PaneMapping &pane, const glm::dvec2 &pixel) {
    return QPointF(pixel.x + 0.5, pixel.y + 0.5) / pane.pixelRatio;
}

QPointF inside(const QRect &area, const QPointF &p) {
    const QRectF seen = QRectF(area).adjusted(1.5, 4.5, -1.5, -1.5); // below the pane's bar
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

// Shares of the axes reach from face to face of the outer samples.
mpr::LatticeBox latticeBox(const classify::CropBox &box, const volume::GridSize &size) {
    const glm::dvec3 n(size.i, size.j, size.k);
    return {box.low * n - 0.5, box.high * n - 0.5};
}

} // namespace

const classify::CropBox &CropTool::shown() const {
    return m_dragged ? m_moved : m_document.scene().crop;
}

std::vector<mpr::BoxEdge> CropTool::outline(const PaneMapping &pane) const {
    const volume::Lattice &lattice = m_document.volume()->lattice();
    return mpr::boxOutline(lattice, latticeBox(shown(), lattice.size()), pane.plane);
}

std::optional<mpr::BoxEdge> CropTool::edgeAt(const PaneMapping &pane, const QPointF &at) const {
    std::optional<mpr::BoxEdge> nearest;
    double least = reach;
    for (const mpr::BoxEdge &edge : outline(pane)) {
        const double d = distance(at, position(pane, edge.from), position(pane, edge.to));
        if (edge.axis >= 0 && d < least) {
            least = d;
            nearest = edge;
        }
    }
    return nearest;
}

bool CropTool::press(const PaneMapping &pane, const QPointF &at) {
    const auto edge = edgeAt(pane, at);
    if (!edge)
        return false;
    m_moved = m_document.scene().crop;
    m_dragged = Face{edge->axis, edge->isHigh};
    return true;
}

void CropTool::move(const PaneMapping &pane, const QPointF &at) {
    const volume::Lattice &lattice = m_document.volume()->lattice();
    const int axis = m_dragged->axis, count = lattice.size()[axis];
    // Faces lie between samples.
    const double voxel = lattice.voxel(pane.patientAt(at)).v[axis];
    const double share = std::clamp(std::round(voxel + 0.5), 0.0, double(count)) / count;
    const double one = 1.0 / count;
    if (m_dragged->isHigh)
        m_moved.high[axis] = std::max(share, m_moved.low[axis] + one);
    else
        m_moved.low[axis] = std::min(share, m_moved.high[axis] - one);
}

void CropTool::release() {
    if (!m_dragged)
        return;
    m_dragged.reset();
    if (m_moved == m_document.scene().crop)
        return;
    scene::Scene scene = m_document.scene();
    scene.crop = m_moved;
    m_document.undoStack()->push(
        new EditScene(m_document, scene, QCoreApplication::translate("CropTool", "Crop")));
}

std::optional<Qt::CursorShape> CropTool::cursorAt(const PaneMapping &pane,
                                                  const QPointF &at) const {
    const auto edge = edgeAt(pane, at);
    if (!edge)
        return std::nullopt;
    const glm::dvec2 along = edge->to - edge->from;
    return std::abs(along.x) > std::abs(along.y) ? Qt::SizeVerCursor : Qt::SizeHorCursor;
}

void CropTool::paint(QPainter &painter, const PaneMapping &pane, const QRect &area, bool withLines,
                     const OverlayColors &colors) const {
    const bool isWhole = shown().isWhole();
    if (isWhole && !withLines)
        return;
    const auto edges = outline(pane);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    if (!isWhole) {
        QPainterPath outside;
        outside.addRect(area);
        QPolygonF inside;
        for (const mpr::BoxEdge &edge : edges)
            inside << position(pane, edge.from);
        if (!inside.isEmpty()) {
            QPainterPath hole;
            hole.addPolygon(inside);
            hole.closeSubpath();
            outside = outside.subtracted(hole);
        }
        painter.fillPath(outside, QColor(0, 0, 0, outsideAlpha));
    }
    for (const mpr::BoxEdge &edge : edges) {
        if (edge.axis < 0)
            continue;
        const bool isTaken =
            m_dragged && m_dragged->axis == edge.axis && m_dragged->isHigh == edge.isHigh;
        painter.setPen(QPen(colors.accent, isTaken ? 2.5 : withLines ? 1.5 : 1.0));
        // Of a volume that fills the pane the sides lie on its border.
        const QPointF from = inside(area, position(pane, edge.from)),
                      to = inside(area, position(pane, edge.to));
        painter.drawLine(from, to);
        if (withLines) {
            painter.setBrush(colors.accent);
            painter.drawEllipse(0.5 * (from + to), 3.5, 3.5);
        }
    }
    painter.restore();
}

} // namespace pellucid::ui
