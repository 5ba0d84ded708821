// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/measurement_painter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <QLineF>
#include <QPainter>

#include "ui/language/measurement_text.h"
#include "ui/views/tools/measurement_figure.h"

namespace pellucid::ui {

namespace {

// Finds a position for a text near one of its figure's points, where it covers no other text and,
// if possible, no line. *Units*: logical pixels.
QRect placeOf(const QSize &text, const std::vector<QPointF> &points, const QRect &viewport,
              const std::vector<QRect> &taken, const QRegion &lines) {
    const int w = text.width(), h = text.height();
    const auto isFree = [&](const QRect &area) {
        return viewport.contains(area) &&
               std::none_of(taken.begin(), taken.end(),
                            [&](const QRect &other) { return other.intersects(area); });
    };
    std::optional<QRect> found;
    for (int distance = 10; distance < 200; distance += 14) {
        for (const QPointF &point : points) {
            const QPoint p = point.toPoint();
            for (const QPoint &at :
                 {p + QPoint(distance, -8), p + QPoint(-distance - w, -8),
                  p + QPoint(-w / 2, distance), p + QPoint(-w / 2, -distance - h)}) {
                const QRect area(at, text);
                if (!isFree(area))
                    continue;
                if (!lines.intersects(area.adjusted(-3, -2, 3, 2)))
                    return area;
                if (!found)
                    found = area;
            }
        }
    }
    if (found)
        return *found;
    // If the pane is full, overlap is unavoidable.
    QRect area(points.front().toPoint(), text);
    area.translate(std::min(0, viewport.right() - area.right()),
                   std::min(0, viewport.bottom() - area.bottom()));
    return area;
}

QRegion regionAround(const QPolygonF &outline) {
    QRegion region;
    for (qsizetype n = 1; n < outline.size(); ++n) {
        // Use short pieces: the bounding box of a long oblique line is mostly empty.
        const QLineF line(outline[n - 1], outline[n]);
        const int pieces = std::clamp(int(line.length() / 12.0), 1, 200);
        for (int k = 0; k < pieces; ++k)
            region += QRectF(line.pointAt(double(k) / pieces), line.pointAt(double(k + 1) / pieces))
                          .normalized()
                          .toAlignedRect()
                          .adjusted(-1, -1, 1, 1);
    }
    return region;
}

// The areas of the orientation letters, which no text may cover.
std::vector<QRect> lettersOf(const QRect &viewport) {
    const QRegion upperAndLower = upperAndLowerLetters(viewport);
    std::vector<QRect> letters(upperAndLower.begin(), upperAndLower.end());
    letters.emplace_back(0, viewport.center().y() - 12, 26, 24);
    letters.emplace_back(viewport.right() - 26, viewport.center().y() - 12, 26, 24);
    return letters;
}

// The grips on the pane, from right to left.
std::vector<QPointF> gripsOn(const PaneMapping &mapping, const measure::Measurement &measurement) {
    std::vector<QPointF> points;
    for (const glm::dvec3 &p : gripsOf(measurement))
        if (const QPointF at = mapping.positionOf({p});
            std::abs(at.x()) < 1e6 && std::abs(at.y()) < 1e6) // not far outside the pane
            points.push_back(at);
    std::sort(points.begin(), points.end(),
              [](const QPointF &a, const QPointF &b) { return a.x() > b.x(); });
    return points;
}

// The points that a text may be beside: for an arrow its tail, for others the grips.
std::vector<QPointF> anchorsOf(const PaneMapping &mapping, const measure::Measurement &m) {
    return m.kind == measure::Kind::arrow ? std::vector{mapping.positionOf({m.pointsMm[1]})}
                                          : gripsOn(mapping, m);
}

// All figures if they leave most of the pane free, otherwise the main one.
QString fittingText(const QFontMetrics &metrics, const Measured &measured, const QSize &pane,
                    const volume::Volume &volume) {
    constexpr double maxShare = 0.3; // of the pane's sides
    const QString all = allFigures(measured.measurement, measured.result, volume).join('\n');
    const QSize size = metrics.boundingRect(QRect(0, 0, 400, 200), Qt::AlignLeft, all).size();
    const QString main = mainFigure(measured.result, volume);
    const bool isLarge =
        size.height() > maxShare * pane.height() && size.height() > 2 * metrics.height();
    return isLarge && !main.isEmpty() ? main : all;
}

// Draws a line from a figure to its text if the text is far away.
void paintLeader(QPainter &painter, const std::vector<QPointF> &points, const QRect &area,
                 const QColor &color) {
    const QPointF nearest =
        *std::min_element(points.begin(), points.end(), [&](const QPointF &a, const QPointF &b) {
            return QLineF(a, area.center()).length() < QLineF(b, area.center()).length();
        });
    const QPointF edge(std::clamp(nearest.x(), qreal(area.left()), qreal(area.right())),
                       std::clamp(nearest.y(), qreal(area.top()), qreal(area.bottom())));
    if (QLineF(nearest, edge).length() > 26.0) {
        painter.setPen(QPen(color, 1.0, Qt::DotLine));
        painter.drawLine(nearest, edge);
    }
}

} // namespace

void paintMeasurements(QPainter &painter, const ToolSurface &surface,
                       const std::vector<DrawnMeasurement> &drawn, const volume::Volume &volume) {
    const PaneMapping &mapping = surface.mapping;
    const auto colorOf = [&](const DrawnMeasurement &d) {
        return d.isSelected ? surface.colors.accent : surface.colors.curve;
    };
    // Draw all lines first: each text avoids all lines and the texts before it.
    QRegion lines;
    for (const DrawnMeasurement &d : drawn) {
        paintMeasurement(painter, mapping, d.measured.measurement, colorOf(d), d.isSelected);
        for (const QPolygonF &outline : outlinesOf(d.measured.measurement, mapping))
            lines += regionAround(outline);
    }
    const QRect viewport(0, 0, int(mapping.plane.width / mapping.pixelRatio),
                         int(mapping.plane.height / mapping.pixelRatio));
    std::vector<QRect> taken = lettersOf(viewport);
    for (const DrawnMeasurement &d : drawn) {
        const std::vector<QPointF> points = anchorsOf(mapping, d.measured.measurement);
        const QString text =
            fittingText(painter.fontMetrics(), d.measured, viewport.size(), volume);
        if (points.empty() || text.isEmpty())
            continue;
        const QSize size =
            painter.fontMetrics().boundingRect(QRect(0, 0, 400, 200), Qt::AlignLeft, text).size();
        const QRect area = placeOf(size, points, viewport.adjusted(6, 4, -6, -4), taken, lines);
        taken.push_back(area.adjusted(-5, -3, 5, 3));
        paintLeader(painter, points, area, colorOf(d));
        painter.fillRect(area.adjusted(-4, -2, 4, 2), QColor(0, 0, 0, 165));
        drawText(painter, area, Qt::AlignLeft, text, colorOf(d));
    }
}

void paintMeasurement(QPainter &painter, const PaneMapping &mapping, const measure::Measurement &m,
                      const QColor &color, bool isSelected) {
    std::vector<QPolygonF> outlines = outlinesOf(m, mapping);
    if (const QPolygonF head = arrowHeadOf(m, mapping); !head.isEmpty())
        outlines.push_back(head);
    // A dark line underneath keeps it legible on bone.
    for (const QPen &pen : {QPen(QColor(0, 0, 0, 150), 3.0), QPen(color, 1.4)}) {
        painter.setPen(pen);
        for (const QPolygonF &outline : outlines)
            painter.drawPolyline(outline);
    }
    if (m.kind == measure::Kind::cobbAngle && outlines.size() == 2) {
        // Shows which two lines belong together.
        painter.setPen(QPen(color, 1.0, Qt::DotLine));
        painter.drawLine(0.5 * (outlines[0][0] + outlines[0][1]),
                         0.5 * (outlines[1][0] + outlines[1][1]));
        painter.setPen(QPen(color, 1.4));
    }
    const bool hasCrosses = !measure::isRegion(m.kind) && m.kind != measure::Kind::arrow;
    for (const glm::dvec3 &p : gripsOf(m)) {
        const QPointF at = mapping.positionOf({p});
        if (isSelected) {
            painter.setBrush(QColor(0, 0, 0, 160));
            painter.drawEllipse(at, 3.5, 3.5);
            painter.setBrush(Qt::NoBrush);
        } else if (hasCrosses) {
            painter.drawLine(at - QPointF(3, 3), at + QPointF(3, 3));
            painter.drawLine(at - QPointF(3, -3), at + QPointF(3, -3));
        }
    }
}

} // namespace pellucid::ui
