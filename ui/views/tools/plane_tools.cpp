// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/plane_tools.h"

#include <algorithm>

#include "ui/views/tools/crop_tool.h"
#include "ui/views/tools/crosshair_tool.h"
#include "ui/views/tools/grow_tool.h"
#include "ui/views/tools/lasso_tool.h"
#include "ui/views/tools/measure_tool.h"
#include "ui/views/tools/paint_tool.h"
#include "ui/views/tools/pan_tool.h"
#include "ui/views/tools/window_tool.h"
#include "ui/views/tools/zoom_tool.h"

namespace pellucid::ui {

PlaneTools::PlaneTools(Document &document, mpr::Orientation orientation, ToolPane &pane) {
    auto crosshair = std::make_unique<CrosshairTool>(document, pane, orientation);
    auto measure = std::make_unique<MeasureTool>(document, pane, MeasureTool::Figures::inPatient);
    m_crosshair = crosshair.get();
    m_measure = measure.get();
    add(Tool::crop, std::make_unique<CropTool>(document, pane));
    add(Tool::crosshair, std::move(crosshair));
    add(Tool::window, std::make_unique<WindowTool>(document));
    add(Tool::pan, std::make_unique<PanTool>(pane, Qt::OpenHandCursor));
    add(Tool::zoom, std::make_unique<ZoomTool>(pane));
    add(Tool::distance, std::move(measure)); // and all other kinds of measurements
    add(Tool::connected, std::make_unique<GrowTool>(document, pane, PaneView::plane));
    add(Tool::paint, std::make_unique<PaintTool>(document, pane, PaneView::plane));
    add(Tool::scissors, std::make_unique<LassoTool>(document, pane));
    m_chosen = find(Tool::window);
}

PlaneTools::~PlaneTools() = default;

void PlaneTools::add(Tool tool, std::unique_ptr<PaneTool> made) {
    m_tools.emplace_back(tool, std::move(made));
}

PaneTool *PlaneTools::find(Tool tool) const {
    if (measuredBy(tool))
        return m_measure;
    return std::find_if(m_tools.begin(), m_tools.end(),
                        [&](const auto &entry) { return entry.first == tool; })
        ->second.get();
}

void PlaneTools::choose(Tool tool) {
    dropUnfinished();
    m_chosen = find(tool);
    m_measure->setKind(measuredBy(tool));
}

// The selected tool has priority over measurements.
PaneTool &PlaneTools::toolAt(const QPointF &at) const {
    return m_showsMeasurements && !m_chosen->gripCursor(at) && m_measure->gripCursor(at)
               ? *m_measure
               : *m_chosen;
}

Qt::CursorShape PlaneTools::cursorAt(const QPointF &at) const {
    const PaneTool &tool = toolAt(at);
    return tool.gripCursor(at).value_or(tool.cursor());
}

void PlaneTools::press(Qt::MouseButton button, const QPointF &at) {
    if (m_button != Qt::NoButton || (button != Qt::LeftButton && button != Qt::MiddleButton))
        return;
    m_button = button;
    m_last = at.toPoint();
    PaneTool &tool = button == Qt::MiddleButton ? *find(Tool::pan) : toolAt(at);
    m_activeTool = tool.press(at) ? &tool : nullptr;
}

bool PlaneTools::move(const QPointF &at) {
    const MouseMove mouse{at, at.toPoint() - m_last};
    m_last = at.toPoint();
    // An unfinished angle gets all moves, with or without a button.
    if (m_measure->isBusy())
        return m_measure->move(mouse);
    if (m_button == Qt::NoButton)
        return m_chosen->hover(at);
    return m_activeTool == nullptr || m_activeTool->move(mouse);
}

void PlaneTools::leave() {
    m_chosen->leave();
}

void PlaneTools::release(Qt::MouseButton button, const QPointF &at) {
    if (button != m_button)
        return;
    if (m_activeTool != nullptr)
        m_activeTool->release(at);
    m_activeTool = nullptr;
    m_button = Qt::NoButton;
}

bool PlaneTools::doublePress(const QPointF &at) {
    return (m_showsMeasurements || m_measure->isBusy()) && m_measure->doublePress(at);
}

bool PlaneTools::finishFigure() {
    return m_measure->finishPolyline();
}

int PlaneTools::measurementAt(const QPointF &at) const {
    return m_showsMeasurements ? m_measure->at(at) : -1;
}

bool PlaneTools::isBusy() const {
    return std::any_of(m_tools.begin(), m_tools.end(),
                       [](const auto &entry) { return entry.second->isBusy(); });
}

bool PlaneTools::isMeasuring() const {
    return m_measure->isBusy();
}

void PlaneTools::dropUnfinished() {
    for (const auto &[tool, paneTool] : m_tools)
        paneTool->cancel();
}

void PlaneTools::cancel() {
    dropUnfinished();
    m_activeTool = nullptr;
    m_button = Qt::NoButton;
}

void PlaneTools::moveCrosshair(const QPointF &at) {
    m_crosshair->moveTo(at.toPoint());
}

void PlaneTools::paint(QPainter &painter, const ToolSurface &surface, const Overlays &shown) const {
    for (const auto &[tool, paneTool] : m_tools) {
        const bool isChosen = paneTool.get() == m_chosen;
        // A tool in use shows its own marks.
        const bool isHidden = (paneTool.get() == m_measure && !shown.texts) ||
                              (paneTool.get() == m_crosshair && !shown.crosshair);
        if (isChosen || !isHidden)
            paneTool->paint(painter, surface, isChosen ? Marks::chosen : Marks::shown);
    }
}

void PlaneTools::paintPlain(QPainter &painter, const ToolSurface &surface, Names names) const {
    for (const auto &[tool, paneTool] : m_tools)
        paneTool->paint(painter, surface, names == Names::shown ? Marks::plain : Marks::nameless);
}

} // namespace pellucid::ui
