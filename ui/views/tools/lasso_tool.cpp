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

constexpr double minStepPixels = 2.0, minSidePixels = 4.0;
constexpr int insideAlpha = 50;

} // namespace

bool LassoTool::press(const QPointF &at) {
    if (!m_document.volume() || m_document.isPreview())
        return false;
    const PaneMapping mapping = m_pane.mapping();
    m_cut = {{mapping.patientAt(at)}, glm::normalize(mapping.plane.axes.toViewer()), {}, false};
    return true;
}

bool LassoTool::move(const MouseMove &mouse) {
    if (!isBusy())
        return false;
    const PaneMapping mapping = m_pane.mapping();
    const QPointF last = mapping.positionOf(m_cut.outline[m_cut.outline.size() - 1]);
    if (QLineF(last, mouse.at).length() >= minStepPixels &&
        m_cut.outline.size() < classify::maxPoints)
        m_cut.outline.push_back(mapping.patientAt(mouse.at));
    return true;
}

QPolygonF LassoTool::outlineOn(const PaneMapping &mapping) const {
    QPolygonF outline;
    for (const volume::PatientPoint &corner : m_cut.outline)
        outline << mapping.positionOf(corner);
    return outline;
}

void LassoTool::release(const QPointF &at) {
    if (!isBusy())
        return;
    move({at, {}});
    const QRectF sides = outlineOn(m_pane.mapping()).boundingRect();
    classify::LassoCut cut = std::exchange(m_cut, {});
    // A click is no outline.
    if (cut.outline.size() < 3 || sides.width() < minSidePixels || sides.height() < minSidePixels)
        return;
    if (const double slab = m_document.marking().options().slabMm; slab > 0.0) {
        const double middle = glm::dot(m_document.crosshair().mm, cut.sight);
        cut.slabMm = {middle - 0.5 * slab, middle + 0.5 * slab};
    }
    useCut(m_document, cut);
}

void LassoTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    if (!isBusy() || marks <= Marks::plain)
        return;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    QColor inside = surface.colors.accent;
    inside.setAlpha(insideAlpha);
    painter.setBrush(inside);
    painter.setPen(QPen(surface.colors.accent, 1.5));
    painter.drawPolygon(outlineOn(surface.mapping), Qt::WindingFill);
    painter.restore();
}

} // namespace pellucid::ui
