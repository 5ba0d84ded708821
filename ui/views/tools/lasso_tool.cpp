// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/lasso_tool.h"

#include <utility>

#include <QLineF>
#include <QPainter>

#include <glm/geometric.hpp>

#include "ui/document/document.h"
#include "ui/document/region_commands.h"

namespace pellucid::ui {

namespace {

constexpr double leastStepPixels = 2.0, leastSidePixels = 4.0;
constexpr int insideAlpha = 50;

} // namespace

bool LassoTool::press(const QPointF &at) {
    if (!m_document.volume() || m_document.isPreview())
        return false;
    m_outline = QPolygonF({at});
    return true;
}

void LassoTool::add(const QPointF &at) {
    if (QLineF(m_outline.back(), at).length() >= leastStepPixels &&
        std::size_t(m_outline.size()) < classify::maxPoints)
        m_outline << at;
}

bool LassoTool::move(const MouseMove &mouse) {
    if (!isBusy())
        return false;
    add(mouse.at);
    return true;
}

void LassoTool::release(const QPointF &at) {
    if (!isBusy())
        return;
    add(at);
    const QPolygonF outline = std::exchange(m_outline, {});
    const QRectF sides = outline.boundingRect();
    // A click is no outline.
    if (outline.size() < 3 || sides.width() < leastSidePixels || sides.height() < leastSidePixels)
        return;
    const PaneMapping mapping = m_pane.mapping();
    classify::LassoCut cut;
    cut.sight = glm::normalize(mapping.plane.axes.toViewer());
    for (const QPointF &corner : outline)
        cut.outline.push_back(mapping.patientAt(corner));
    if (const double slab = m_document.marking().options().slabMm; slab > 0.0) {
        const double middle = glm::dot(m_document.crosshair().mm, cut.sight);
        cut.slabMm = {middle - 0.5 * slab, middle + 0.5 * slab};
    }
    useCut(m_document, cut);
}

void LassoTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    if (!isBusy() || marks == Marks::plain)
        return;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    QColor inside = surface.colors.accent;
    inside.setAlpha(insideAlpha);
    painter.setBrush(inside);
    painter.setPen(QPen(surface.colors.accent, 1.5));
    painter.drawPolygon(m_outline, Qt::WindingFill);
    painter.restore();
}

} // namespace pellucid::ui
