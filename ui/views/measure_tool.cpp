// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/measure_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <QCoreApplication>
#include <QLineF>
#include <QPainter>

#include <glm/geometric.hpp>

#include "ui/document/document.h"
#include "ui/language/measurement_text.h"
#include "ui/views/overlay.h"

namespace pellucid::ui {

namespace {

using measure::Kind;
using measure::Measurement;

constexpr double gripPixels = 6.0, leastDragPixels = 4.0;

struct MeasureToolTexts {
    Q_DECLARE_TR_FUNCTIONS(MeasureToolTexts)
};

// The places a hand can take it by: its points, of a region the four corners of its box.
std::vector<glm::dvec3> gripsOf(const Measurement &m) {
    if (!measure::isRegion(m.kind))
        return m.pointsMm;
    const glm::dvec3 a = m.pointsMm[0], b = m.pointsMm[1];
    const glm::dvec3 across = glm::dot(b - a, m.axes.right) * m.axes.right;
    return {a, a + across, b, b - across};
}

void moveGrip(Measurement &m, int grip, const glm::dvec3 &to) {
    if (measure::isRegion(m.kind)) {
        // A region stays in its plane, though the slice beside it may be the one that is shown.
        const glm::dvec3 opposite = gripsOf(m)[std::size_t((grip + 2) % 4)],
                         normal = m.axes.toViewer();
        m.pointsMm = {opposite, to - glm::dot(to - opposite, normal) * normal};
    } else {
        m.pointsMm[std::size_t(grip)] = to;
    }
}

double distanceToSegment(const QPointF &p, const QPointF &a, const QPointF &b) {
    const QPointF d = b - a;
    const double square = QPointF::dotProduct(d, d);
    const double t =
        square > 0.0 ? std::clamp(QPointF::dotProduct(p - a, d) / square, 0.0, 1.0) : 0.0;
    return QLineF(p, a + t * d).length();
}

// The outline on the widget, closed for regions.
QPolygonF outlineOf(const Measurement &m, const PaneMapping &mapping) {
    QPolygonF outline;
    const auto add = [&](const glm::dvec3 &mm) { outline << mapping.positionOf({mm}); };
    if (m.kind == Kind::ellipse) {
        const glm::dvec3 center = 0.5 * (m.pointsMm[0] + m.pointsMm[1]),
                         half = 0.5 * (m.pointsMm[1] - m.pointsMm[0]);
        constexpr int corners = 72;
        for (int n = 0; n <= corners; ++n) {
            const double t = 2.0 * std::numbers::pi * n / corners;
            add(center + std::cos(t) * glm::dot(half, m.axes.right) * m.axes.right +
                std::sin(t) * glm::dot(half, m.axes.up) * m.axes.up);
        }
    } else {
        for (const glm::dvec3 &p : gripsOf(m))
            add(p);
        if (m.kind == Kind::rectangle)
            outline << outline.first();
    }
    return outline;
}

} // namespace

MeasureTool::MeasureTool(Document &document, bool isProjection)
    : m_document(document), m_isProjection(isProjection) {}

bool MeasureTool::isShown(const Measurement &m, const Pane &pane) const {
    const mpr::Plane &plane = pane.mapping.plane;
    const double along = std::abs(glm::dot(m.axes.toViewer(), plane.axes.toViewer()));
    if ((m.kind == Kind::projectedDistance) != m_isProjection)
        return false;
    if (m_isProjection) // a tenth of a degree from where it was drawn it has another length
        return along > 0.999999;
    if (measure::isRegion(m.kind) && along < 0.999)
        return false;
    return std::all_of(m.pointsMm.begin(), m.pointsMm.end(), [&](const glm::dvec3 &p) {
        return std::abs(glm::dot(p - plane.center.mm, plane.axes.toViewer())) <= pane.reachMm;
    });
}

std::optional<MeasureTool::Hit> MeasureTool::hitAt(const Pane &pane, const QPointF &at) const {
    const std::vector<Measured> &all = m_document.measured();
    std::optional<Hit> whole;
    // What was drawn last lies on top.
    for (int n = int(all.size()) - 1; n >= 0; --n) {
        const Measurement &m = all[std::size_t(n)].measurement;
        if (!isShown(m, pane))
            continue;
        const auto grips = gripsOf(m);
        for (std::size_t g = 0; g < grips.size(); ++g)
            if (QLineF(pane.mapping.positionOf({grips[g]}), at).length() <= gripPixels)
                return Hit{n, int(g)};
        const QPolygonF outline = outlineOf(m, pane.mapping);
        for (qsizetype p = 1; p < outline.size() && !whole; ++p)
            if (distanceToSegment(at, outline[p - 1], outline[p]) <= gripPixels - 2.0)
                whole = Hit{n, -1};
    }
    return whole;
}

bool MeasureTool::isOver(const Pane &pane, const QPointF &at) const {
    return hitAt(pane, at).has_value();
}

bool MeasureTool::press(const Pane &pane, const QPointF &at, std::optional<Kind> kind) {
    if (m_document.isPreview())
        return false;
    const glm::dvec3 mm = pane.mapping.patientAt(at).mm;
    if (m_grip == Grip::thirdPoint) {
        m_current.pointsMm[2] = mm;
        finish();
        return true;
    }
    m_pressed = at;
    m_lastMm = mm;
    m_drag = nextDragId();
    if (const auto hit = hitAt(pane, at)) {
        m_grip = hit->point < 0 ? Grip::whole : Grip::point;
        m_index = hit->index;
        m_point = hit->point;
        m_current = m_written = m_document.measured()[std::size_t(hit->index)].measurement;
        m_document.selectMeasurement(hit->index);
        return true;
    }
    if (!kind)
        return false;
    m_grip = Grip::making;
    m_current = {m_isProjection ? Kind::projectedDistance : *kind,
                 {},
                 std::vector<glm::dvec3>(measure::pointCount(*kind), mm),
                 pane.mapping.plane.axes};
    return true;
}

void MeasureTool::move(const Pane &pane, const QPointF &at) {
    const glm::dvec3 mm = pane.mapping.patientAt(at).mm;
    switch (m_grip) {
    case Grip::none:
        return;
    case Grip::making:
        m_current.pointsMm[1] = mm;
        if (m_current.kind == Kind::angle)
            m_current.pointsMm[2] = mm;
        break;
    case Grip::thirdPoint:
        m_current.pointsMm[2] = mm;
        break;
    case Grip::point:
        moveGrip(m_current, m_point, mm);
        if (measure::isRegion(m_current.kind))
            m_point = 2; // the corner that was taken is the second point now
        edit(MeasureToolTexts::tr("Change %1").arg(QString::fromStdString(m_current.name)));
        break;
    case Grip::whole:
        for (glm::dvec3 &p : m_current.pointsMm)
            p += mm - m_lastMm;
        m_lastMm = mm;
        edit(MeasureToolTexts::tr("Move %1").arg(QString::fromStdString(m_current.name)));
        break;
    }
}

void MeasureTool::release(const Pane &pane, const QPointF &at) {
    if (m_grip == Grip::making) {
        if (QLineF(at, m_pressed).length() < leastDragPixels)
            m_grip = Grip::none; // a click is no measurement
        else if (m_current.kind == Kind::angle)
            m_grip = Grip::thirdPoint;
        else {
            move(pane, at);
            finish();
        }
    } else if (m_grip != Grip::thirdPoint) {
        m_grip = Grip::none;
    }
}

void MeasureTool::cancel() {
    m_grip = Grip::none;
}

void MeasureTool::finish() {
    m_grip = Grip::none;
    auto all = m_document.measurements();
    // Numbered on from the last of its kind that has a number.
    const QString kind = kindText(m_current.kind);
    int number = 0;
    for (const Measurement &m : all)
        if (const QString name = QString::fromStdString(m.name); name.startsWith(kind + " "))
            number = std::max(number, name.mid(kind.size() + 1).toInt());
    m_current.name = QString("%1 %2").arg(kind).arg(number + 1).toStdString();
    all.push_back(m_current);
    m_document.undoStack()->push(new EditMeasurements(m_document, all, kind));
    m_document.selectMeasurement(int(all.size()) - 1);
}

void MeasureTool::edit(const QString &text) {
    auto all = m_document.measurements();
    // Undone or deleted under the hand: what has its place now is another one.
    if (m_index >= int(all.size()) || all[std::size_t(m_index)] != m_written) {
        m_grip = Grip::none;
        return;
    }
    all[std::size_t(m_index)] = m_written = m_current;
    m_document.undoStack()->push(new EditMeasurements(m_document, all, text, m_drag));
}

namespace {

// A place for a figure's text near one of its points that covers no other text and, if there is
// one, no line. *Units*: logical pixels.
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
    // In a pane that is full: in its corner, whatever is there.
    QRect area(points.front().toPoint(), text);
    area.translate(std::min(0, viewport.right() - area.right()),
                   std::min(0, viewport.bottom() - area.bottom()));
    return area;
}

QRegion regionAround(const QPolygonF &outline) {
    QRegion region;
    for (qsizetype n = 1; n < outline.size(); ++n) {
        // Short pieces: the box of a long oblique line is mostly empty.
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

} // namespace

void MeasureTool::paint(QPainter &painter, const Pane &pane, const OverlayColors &colors,
                        Marks marks) const {
    const bool isMaking = m_grip == Grip::making || m_grip == Grip::thirdPoint;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const auto &all = m_document.measured();
    const auto isSelected = [&](std::size_t n) {
        return marks == Marks::withSelection && int(n) == m_document.selectedMeasurement();
    };
    const auto colorOf = [&](std::size_t n) {
        return isSelected(n) ? colors.accent : colors.curve;
    };
    QRegion lines;
    for (std::size_t n = 0; n < all.size(); ++n)
        if (const Measurement &m = all[n].measurement; isShown(m, pane)) {
            paintOne(painter, pane, m, colorOf(n), isSelected(n));
            lines += regionAround(outlineOf(m, pane.mapping));
        }
    // All lines first: a text stands on none, and beside the texts before it.
    const QRect viewport(0, 0, int(pane.mapping.plane.width / pane.mapping.pixelRatio),
                         int(pane.mapping.plane.height / pane.mapping.pixelRatio));
    // The patient's sides stay legible.
    const QRegion upperAndLower = upperAndLowerLetters(viewport);
    std::vector<QRect> taken(upperAndLower.begin(), upperAndLower.end());
    taken.emplace_back(0, viewport.center().y() - 12, 26, 24);
    taken.emplace_back(viewport.right() - 26, viewport.center().y() - 12, 26, 24);
    for (std::size_t n = 0; n < all.size(); ++n) {
        const Measurement &m = all[n].measurement;
        if (!isShown(m, pane))
            continue;
        std::vector<QPointF> points;
        for (const glm::dvec3 &p : gripsOf(m))
            if (const QPointF at = pane.mapping.positionOf({p});
                std::abs(at.x()) < 1e6 && std::abs(at.y()) < 1e6) // far outside of the pane
                points.push_back(at);
        std::sort(points.begin(), points.end(),
                  [](const QPointF &a, const QPointF &b) { return a.x() > b.x(); });
        const QString text = allFigures(m, all[n].result, *m_document.volume()).join('\n');
        if (points.empty() || text.isEmpty())
            continue;
        const QSize size =
            painter.fontMetrics().boundingRect(QRect(0, 0, 400, 200), Qt::AlignLeft, text).size();
        const QRect area = placeOf(size, points, viewport.adjusted(6, 4, -6, -4), taken, lines);
        taken.push_back(area.adjusted(-5, -3, 5, 3));
        // Far from its figure, a line leads there.
        const QPointF nearest = *std::min_element(
            points.begin(), points.end(), [&](const QPointF &a, const QPointF &b) {
                return QLineF(a, area.center()).length() < QLineF(b, area.center()).length();
            });
        const QPointF edge(std::clamp(nearest.x(), qreal(area.left()), qreal(area.right())),
                           std::clamp(nearest.y(), qreal(area.top()), qreal(area.bottom())));
        if (QLineF(nearest, edge).length() > 26.0) {
            painter.setPen(QPen(colorOf(n), 1.0, Qt::DotLine));
            painter.drawLine(nearest, edge);
        }
        painter.fillRect(area.adjusted(-4, -2, 4, 2), QColor(0, 0, 0, 165));
        drawText(painter, area, Qt::AlignLeft, text, colorOf(n));
    }
    if (isMaking)
        paintOne(painter, pane, m_current, colors.accent, true);
    painter.restore();
}

void MeasureTool::paintOne(QPainter &painter, const Pane &pane, const Measurement &m,
                           const QColor &color, bool isSelected) const {
    const QPolygonF outline = outlineOf(m, pane.mapping);
    // A dark line below keeps it legible on bone.
    painter.setPen(QPen(QColor(0, 0, 0, 150), 3.0));
    painter.drawPolyline(outline);
    painter.setPen(QPen(color, 1.4));
    painter.drawPolyline(outline);
    for (const glm::dvec3 &p : gripsOf(m)) {
        const QPointF at = pane.mapping.positionOf({p});
        if (isSelected) {
            painter.setBrush(QColor(0, 0, 0, 160));
            painter.drawEllipse(at, 3.5, 3.5);
            painter.setBrush(Qt::NoBrush);
        } else if (!measure::isRegion(m.kind)) {
            painter.drawLine(at - QPointF(3, 3), at + QPointF(3, 3));
            painter.drawLine(at - QPointF(3, -3), at + QPointF(3, -3));
        }
    }
}

} // namespace pellucid::ui
