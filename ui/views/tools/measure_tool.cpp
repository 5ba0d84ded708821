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

QString nameOf(const Measurement &m) {
    return m.name.empty() ? kindText(m) : QString::fromStdString(m.name);
}

} // namespace

MeasureTool::MeasureTool(Document &document, ToolPane &pane, Figures figures)
    : m_document(document), m_pane(pane), m_figures(figures) {}

bool MeasureTool::isShown(const Measurement &m, const mpr::Plane &plane) const {
    const double along = std::abs(glm::dot(m.axes.toViewer(), plane.axes.toViewer()));
    if (m.isProjected != (m_figures == Figures::inPicture))
        return false;
    // The figures depend on the view, which must match to a tenth of a degree.
    if (m.isProjected)
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
        for (const QPolygonF &outline : outlinesOf(m, mapping))
            for (qsizetype p = 1; p < outline.size() && !whole; ++p)
                if (distanceToSegment(at, outline[p - 1], outline[p]) <= gripPixels - 2.0)
                    whole = Hit{n, -1};
    }
    return whole;
}

int MeasureTool::at(const QPointF &at) const {
    const auto hit = hitAt(at);
    return hit ? hit->index : -1;
}

std::optional<Qt::CursorShape> MeasureTool::gripCursor(const QPointF &at) const {
    return hitAt(at) ? std::optional(Qt::PointingHandCursor) : std::nullopt;
}

bool MeasureTool::press(const QPointF &at) {
    if (m_document.isPreview())
        return false;
    const glm::dvec3 mm = m_pane.mapping().patientAt(at).mm;
    if (m_grip == Grip::nextPoint) {
        m_current.pointsMm.back() = mm;
        if (m_current.kind != Kind::polyline)
            finish();
        else if (m_current.pointsMm.size() < measure::maxPolylinePoints)
            m_current.pointsMm.push_back(mm);
        else
            finishPolyline();
        return true;
    }
    m_pressed = at;
    if (m_grip == Grip::nextLine) {
        m_current.pointsMm.insert(m_current.pointsMm.end(), 2, mm);
        m_grip = Grip::making;
        return true;
    }
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
    begin(at);
    return true;
}

void MeasureTool::begin(const QPointF &at) {
    const PaneMapping mapping = m_pane.mapping();
    m_current = {*m_kind,
                 {},
                 std::vector<glm::dvec3>(*m_kind == Kind::text ? 1 : 2, mapping.patientAt(at).mm),
                 mapping.plane.axes,
                 m_figures == Figures::inPicture};
    if (*m_kind == Kind::text)
        askForText(at);
    else
        m_grip = *m_kind == Kind::polyline ? Grip::nextPoint : Grip::making;
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
    case Grip::nextLine:
        return;
    case Grip::making:
    case Grip::nextPoint:
        m_current.pointsMm.back() = mm;
        break;
    case Grip::point:
        moveGrip(m_current, m_point, mm);
        if (measure::isRegion(m_current.kind))
            m_point = 2; // the dragged corner is now the second point
        edit(MeasureToolTexts::tr("Change %1").arg(nameOf(m_current)));
        break;
    case Grip::whole:
        for (glm::dvec3 &p : m_current.pointsMm)
            p += mm - m_lastMm;
        m_lastMm = mm;
        edit(MeasureToolTexts::tr("Move %1").arg(nameOf(m_current)));
        break;
    }
}

void MeasureTool::release(const QPointF &at) {
    if (m_grip == Grip::making)
        endDrag(at);
    else if (m_grip == Grip::point || m_grip == Grip::whole)
        m_grip = Grip::none;
}

void MeasureTool::endDrag(const QPointF &at) {
    const bool isSecondLine = m_current.pointsMm.size() == 4;
    if (QLineF(at, m_pressed).length() < minDragPixels) { // a click makes no line
        if (isSecondLine)
            m_current.pointsMm.resize(2);
        m_grip = isSecondLine ? Grip::nextLine : Grip::none;
        return;
    }
    moveTo(at);
    if (m_current.kind == Kind::angle) {
        m_current.pointsMm.push_back(m_current.pointsMm.back());
        m_grip = Grip::nextPoint;
    } else if (m_current.kind == Kind::cobbAngle && !isSecondLine) {
        m_grip = Grip::nextLine;
    } else if (m_current.kind == Kind::arrow) {
        askForText(at);
    } else {
        finish();
    }
}

bool MeasureTool::finishPolyline() {
    if (m_grip != Grip::nextPoint || m_current.kind != Kind::polyline)
        return false;
    m_current.pointsMm.pop_back(); // it followed the mouse
    if (m_current.pointsMm.size() >= measure::pointCount(Kind::polyline).min)
        finish();
    else
        m_grip = Grip::none;
    return true;
}

bool MeasureTool::doublePress(const QPointF &at) {
    if (finishPolyline()) // its last corner is that of the first press
        return true;
    const auto hit = m_grip == Grip::none ? hitAt(at) : std::nullopt;
    if (!hit)
        return false;
    const Measurement &m = m_document.measured()[std::size_t(hit->index)].measurement;
    if (!measure::isAnnotation(m.kind))
        return false;
    m_current = m_stored = m;
    m_pane.askForText(at, QString::fromStdString(m.name),
                      [this, index = hit->index](const QString &text) { rename(index, text); });
    return true;
}

void MeasureTool::askForText(const QPointF &at) {
    m_grip = Grip::none;
    m_pane.askForText(at, {}, [this, made = m_current](const QString &text) {
        // An arrow says enough without words.
        if (text.isEmpty() && made.kind == Kind::text)
            return;
        m_current = made;
        m_current.name = text.toStdString();
        finish();
    });
}

void MeasureTool::rename(int index, const QString &text) {
    m_index = index;
    m_drag = noDrag;
    if (text.isEmpty() && m_current.kind == Kind::text)
        return;
    m_current.name = text.toStdString();
    edit(MeasureToolTexts::tr("Change text"));
}

void MeasureTool::finish() {
    m_grip = Grip::none;
    auto all = m_document.measurements();
    const QString kind = kindText(m_current);
    if (!measure::isAnnotation(m_current.kind)) {
        // Continue the numbering of this kind.
        int number = 0;
        for (const Measurement &m : all)
            if (const QString name = QString::fromStdString(m.name); name.startsWith(kind + " "))
                number = std::max(number, name.mid(kind.size() + 1).toInt());
        m_current.name = (kind + " " + QString::number(number + 1)).toStdString();
    }
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
        // The user may have typed the name of the patient.
        if (isShown(all[n].measurement, surface.mapping.plane) &&
            !(marks == Marks::nameless && measure::isAnnotation(all[n].measurement.kind)))
            drawn.push_back(
                {all[n], marks > Marks::plain && int(n) == m_document.selectedMeasurement()});
    if (!drawn.empty())
        paintMeasurements(painter, surface, drawn, *m_document.volume());
    if (m_grip == Grip::making || m_grip == Grip::nextPoint || m_grip == Grip::nextLine)
        paintMeasurement(painter, surface.mapping, m_current, surface.colors.accent, true);
    painter.restore();
}

} // namespace pellucid::ui
