// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/crosshair.h"

#include <algorithm>
#include <cmath>

#include <QLineF>
#include <QPainter>

#include <glm/geometric.hpp>

#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

constexpr double handleShare = 0.36, handlePixels = 8.0;

// Horizontal and vertical lines are sharp at pixel centers.
QPointF sharp(const QPointF &at) {
    return {std::floor(at.x()) + 0.5, std::floor(at.y()) + 0.5};
}

} // namespace

const char *colorRole(mpr::Orientation orientation) {
    switch (orientation) {
    case mpr::Orientation::axial:
        return "axial";
    case mpr::Orientation::coronal:
        return "coronal";
    case mpr::Orientation::sagittal:
        break;
    }
    return "sagittal";
}

CrosshairLines::CrosshairLines(const PaneMapping &mapping, volume::PatientPoint crosshair,
                               const mpr::PlaneAxes &axes, mpr::Orientation pane)
    : m_at(mapping.positionOf(crosshair)) {
    std::size_t n = 0;
    const mpr::Axes &own = axes.of(pane);
    for (const mpr::Orientation other : mpr::allOrientations) {
        if (other == pane)
            continue;
        // The direction that lies in both planes.
        const glm::dvec3 along = glm::cross(axes.of(other).toViewer(), own.toViewer());
        m_lines[n++] = {other, {glm::dot(along, own.right), -glm::dot(along, own.up)}};
    }
}

std::array<QPointF, 2> CrosshairLines::handles(const Line &line, const QSize &size) const {
    const double reach = handleShare * std::min(size.width(), size.height());
    return {m_at + reach * line.direction, m_at - reach * line.direction};
}

void CrosshairLines::paint(QPainter &painter, const QSize &size, bool withHandles) const {
    painter.save();
    const double far = size.width() + size.height();
    for (const Line &line : m_lines) {
        QColor color = overlayColors(colorRole(line.plane)).plane;
        const bool isOblique =
            std::min(std::abs(line.direction.x()), std::abs(line.direction.y())) > 1e-6;
        painter.setRenderHint(QPainter::Antialiasing, isOblique);
        const QPointF at = isOblique ? m_at : sharp(m_at);
        color.setAlpha(170);
        painter.setPen(QPen(color, 1));
        painter.drawLine(at - far * line.direction, at + far * line.direction);
        if (!withHandles)
            continue;
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setBrush(color);
        for (const QPointF &handle : handles(line, size))
            painter.drawEllipse(handle, 4.0, 4.0);
    }
    painter.restore();
}

bool CrosshairLines::isHandleAt(const QPointF &position, const QSize &size) const {
    for (const Line &line : m_lines)
        for (const QPointF &handle : handles(line, size))
            if (QLineF(position, handle).length() <= handlePixels)
                return true;
    return false;
}

double CrosshairLines::angleAt(const QPointF &position) const {
    return std::atan2(m_at.y() - position.y(), position.x() - m_at.x());
}

} // namespace pellucid::ui
