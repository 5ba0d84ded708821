// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/pane_tools.h"

#include <algorithm>

#include <QGuiApplication>

#include "ui/views/tools/grow_tool.h"
#include "ui/views/tools/lasso_tool.h"
#include "ui/views/tools/measure_tool.h"
#include "ui/views/tools/paint_tool.h"
#include "ui/views/tools/pan_tool.h"
#include "ui/views/tools/zoom_tool.h"

namespace pellucid::ui {

PaneTools::PaneTools(Document &document, ToolPane &pane, PaneView view) : m_view(view) {
    auto measure = std::make_unique<MeasureTool>(document, pane,
                                                 view == PaneView::projection
                                                     ? MeasureTool::Figures::inPicture
                                                     : MeasureTool::Figures::inPatient);
    m_measure = measure.get();
    add(Tool::scissors, std::make_unique<LassoTool>(document, pane));
    add(Tool::paint, std::make_unique<PaintTool>(document, pane, view));
    add(Tool::connected, std::make_unique<GrowTool>(document, pane, view));
    add(Tool::distance, std::move(measure)); // and all other kinds of measurements
    add(Tool::zoom, std::make_unique<ZoomTool>(pane));
    add(Tool::pan, std::make_unique<PanTool>(pane));
    m_chosen = find(m_selected);
}

PaneTools::~PaneTools() = default;

void PaneTools::add(Tool tool, std::unique_ptr<PaneTool> made) {
    m_tools.emplace(m_tools.begin(), tool, std::move(made));
}

PaneTool *PaneTools::find(Tool tool) const {
    const auto kind = measuredBy(tool);
    const bool isInPicture = m_view == PaneView::projection;
    if (kind && !(isInPicture && measure::isRegion(*kind)))
        return m_measure;
    const auto found = std::find_if(m_tools.begin(), m_tools.end(),
                                    [&](const auto &entry) { return entry.first == tool; });
    if (found != m_tools.end())
        return found->second.get();
    return m_turning ? m_turning.get() : find(Tool::pan); // the pane has no use for this tool
}

void PaneTools::choose(Tool tool) {
    dropUnfinished();
    m_selected = tool;
    m_chosen = find(tool);
    m_measure->setKind(m_chosen == m_measure ? measuredBy(tool) : std::nullopt);
}

// The selected tool has priority over measurements.
PaneTool &PaneTools::toolAt(const QPointF &at) const {
    return m_showsMeasurements && !m_chosen->gripCursor(at) && m_measure->gripCursor(at)
               ? *m_measure
               : *m_chosen;
}

PaneTool *PaneTools::toolOf(Qt::MouseButton button, const QPointF &at) const {
    if (button == Qt::MiddleButton)
        return find(Tool::pan);
    if (button == Qt::RightButton)
        return m_right.get();
    if (button != Qt::LeftButton)
        return nullptr;
    const bool turns =
        m_turning && (QGuiApplication::keyboardModifiers() & Qt::ControlModifier) != 0;
    return turns ? m_turning.get() : &toolAt(at);
}

Qt::CursorShape PaneTools::cursorAt(const QPointF &at) const {
    if (m_activeTool != nullptr)
        return m_gripCursor.value_or(m_activeTool->heldCursor());
    if (m_measure->isBusy())
        return m_measure->cursor();
    const PaneTool &tool = toolAt(at);
    return tool.gripCursor(at).value_or(tool.cursor());
}

void PaneTools::press(Qt::MouseButton button, const QPointF &at) {
    const bool isOfFigure = m_measure->isBusy(); // of several clicks
    PaneTool *const tool = isOfFigure && button == Qt::LeftButton ? m_measure : toolOf(button, at);
    if (m_button != Qt::NoButton || tool == nullptr || (isOfFigure && tool != m_measure))
        return;
    m_button = button;
    m_last = at.toPoint();
    m_gripCursor = tool->gripCursor(at);
    m_activeTool = tool->press(at) ? tool : nullptr;
    // Nothing is measured while a study arrives: the view turns.
    if (m_activeTool == nullptr && tool == m_measure && m_turning && m_turning->press(at))
        m_activeTool = m_turning.get();
}

bool PaneTools::move(const QPointF &at) {
    const MouseMove mouse{at, at.toPoint() - m_last};
    m_last = at.toPoint();
    // An unfinished angle gets all moves, with or without a button.
    if (m_measure->isBusy())
        return m_measure->move(mouse);
    if (m_button == Qt::NoButton)
        return m_chosen->hover(at);
    return m_activeTool == nullptr || m_activeTool->move(mouse);
}

void PaneTools::leave() {
    m_chosen->leave();
}

void PaneTools::release(Qt::MouseButton button, const QPointF &at) {
    if (button != m_button)
        return;
    if (m_activeTool != nullptr)
        m_activeTool->release(at);
    m_activeTool = nullptr;
    m_button = Qt::NoButton;
}

bool PaneTools::doublePress(const QPointF &at) {
    return (m_showsMeasurements || m_measure->isBusy()) && m_measure->doublePress(at);
}

bool PaneTools::finishFigure() {
    return m_measure->finishPolyline();
}

int PaneTools::measurementAt(const QPointF &at) const {
    return m_showsMeasurements ? m_measure->at(at) : -1;
}

bool PaneTools::isBusy() const {
    return std::any_of(m_tools.begin(), m_tools.end(),
                       [](const auto &entry) { return entry.second->isBusy(); });
}

bool PaneTools::isMeasuring() const {
    return m_measure->isBusy();
}

void PaneTools::dropUnfinished() {
    for (const auto &[tool, paneTool] : m_tools)
        paneTool->cancel();
}

void PaneTools::cancel() {
    dropUnfinished();
    m_activeTool = nullptr;
    m_button = Qt::NoButton;
}

void PaneTools::paint(QPainter &painter, const ToolSurface &surface, Marks marks,
                      const Overlays &shown) const {
    for (const auto &[tool, paneTool] : m_tools) {
        const bool isChosen = paneTool.get() == m_chosen;
        const bool isHidden = (tool == Tool::distance && !shown.texts) ||
                              (tool == Tool::crosshair && !shown.crosshair);
        if (marks <= Marks::plain)
            paneTool->paint(painter, surface, marks);
        else if (isChosen || !isHidden) // a tool in use shows its own marks
            paneTool->paint(painter, surface, isChosen ? Marks::chosen : Marks::shown);
    }
}

} // namespace pellucid::ui
