// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/measure_tool.h"

#include <algorithm>
#include <cmath>

#include <QCoreApplication>
#include <QLineF>
#include <QPainter>

#include <glm/geometric.hpp>

#include "ui/document/document.h"
#include "ui/language/measurement_text.h"
#include "ui/views/tools/measurement_figure.h"
#include "ui/views/tools/measurement_painter.h"

namespace pellucid::ui {

namespace {

using measure::Kind;
using measure::Measurement;

constexpr double gripPixels = 6.0, minDragPixels = 4.0;

struct MeasureToolTexts {
    Q_DECLARE_TR_FUNCTIONS(MeasureToolTexts)
};

} // namespace

MeasureTool::MeasureTool(Document &document, const ToolPane &pane, Figures figures)
    : m_document(document), m_pane(pane), m_figures(figures) {}

bool MeasureTool::isShown(const Measurement &m, const mpr::Plane &plane) const {
    const double along = std::abs(glm::dot(m.axes.toViewer(), plane.axes.toViewer()));
    if ((m.kind == Kind::projectedDistance) != (m_figures == Figures::inPicture))
        return false;
    // The length depends on the view, which must match to a tenth of a degree.
    if (m_figures == Figures::inPicture)
        return along > 0.999999;
    if (measure::isRegion(m.kind) && along < 0.999)
        return false;
    const double reachMm = m_pane.reachMm();
    return std::all_of(m.pointsMm.begin(), m.pointsMm.end(), [&](const glm::dvec3 &p) {
        return std::abs(glm::dot(p - plane.center.mm, plane.axes.toViewer())) <= reachMm;
    });
}

std::optional<MeasureTool::Hit> MeasureTool::hitAt(const QPointF &at) const {
    const std::vector<Measured> &all = m_document.measured();
    const PaneMapping mapping = m_pane.mapping();
    std::optional<Hit> whole;
    // The last measurement is on top.
    for (int n = int(all.size()) - 1; n >= 0; --n) {
        const Measurement &m = all[std::size_t(n)].measurement;
        if (!isShown(m, mapping.plane))
            continue;
        const auto grips = gripsOf(m);
        for (std::size_t g = 0; g < grips.size(); ++g)
            if (QLineF(mapping.positionOf({grips[g]}), at).length() <= gripPixels)
                return Hit{n, int(g)};
        const QPolygonF outline = outlineOf(m, mapping);
        for (qsizetype p = 1; p < outline.size() && !whole; ++p)
            if (distanceToSegment(at, outline[p - 1], outline[p]) <= gripPixels - 2.0)
                whole = Hit{n, -1};
    }
    return whole;
}

std::optional<Qt::CursorShape> MeasureTool::gripCursor(const QPointF &at) const {
    return hitAt(at) ? std::optional(Qt::PointingHandCursor) : std::nullopt;
}

bool MeasureTool::press(const QPointF &at) {
    if (m_document.isPreview())
        return false;
    const PaneMapping mapping = m_pane.mapping();
    const glm::dvec3 mm = mapping.patientAt(at).mm;
    if (m_grip == Grip::thirdPoint) {
        m_current.pointsMm[2] = mm;
        finish();
        return true;
    }
    m_pressed = at;
    m_lastMm = mm;
    m_drag = nextDragId();
    if (const auto hit = hitAt(at)) {
        m_grip = hit->point < 0 ? Grip::whole : Grip::point;
        m_index = hit->index;
        m_point = hit->point;
        m_current = m_stored = m_document.measured()[std::size_t(hit->index)].measurement;
        m_document.selectMeasurement(hit->index);
        return true;
    }
    if (!m_kind)
        return false;
    m_grip = Grip::making;
    m_current = {
        *m_kind, {}, std::vector<glm::dvec3>(measure::pointCount(*m_kind), mm), mapping.plane.axes};
    return true;
}

bool MeasureTool::move(const MouseMove &mouse) {
    if (m_grip == Grip::none)
        return false;
    moveTo(mouse.at);
    return true;
}

void MeasureTool::moveTo(const QPointF &at) {
    const glm::dvec3 mm = m_pane.mapping().patientAt(at).mm;
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
            m_point = 2; // the dragged corner is now the second point
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

void MeasureTool::release(const QPointF &at) {
    if (m_grip == Grip::making) {
        if (QLineF(at, m_pressed).length() < minDragPixels)
            m_grip = Grip::none; // a click creates nothing
        else if (m_current.kind == Kind::angle)
            m_grip = Grip::thirdPoint;
        else {
            moveTo(at);
            finish();
        }
    } else if (m_grip != Grip::thirdPoint) {
        m_grip = Grip::none;
    }
}

void MeasureTool::finish() {
    m_grip = Grip::none;
    auto all = m_document.measurements();
    // Continue the numbering of this kind.
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
    // It was undone or deleted during the drag: the index now belongs to a different measurement.
    if (m_index >= int(all.size()) || all[std::size_t(m_index)] != m_stored) {
        m_grip = Grip::none;
        return;
    }
    all[std::size_t(m_index)] = m_stored = m_current;
    m_document.undoStack()->push(new EditMeasurements(m_document, all, text, m_drag));
}

void MeasureTool::paint(QPainter &painter, const ToolSurface &surface, Marks marks) const {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    std::vector<DrawnMeasurement> drawn;
    const std::vector<Measured> &all = m_document.measured();
    for (std::size_t n = 0; n < all.size(); ++n)
        if (isShown(all[n].measurement, surface.mapping.plane))
            drawn.push_back(
                {all[n], marks != Marks::plain && int(n) == m_document.selectedMeasurement()});
    if (!drawn.empty())
        paintMeasurements(painter, surface, drawn, *m_document.volume());
    if (m_grip == Grip::making || m_grip == Grip::thirdPoint)
        paintMeasurement(painter, surface.mapping, m_current, surface.colors.accent, true);
    painter.restore();
}

} // namespace pellucid::ui
