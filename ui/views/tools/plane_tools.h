// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/mpr/plane.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class CrosshairTool;
class Document;
class MeasureTool;

/// The tools of a plane and the current drag. The left button uses the selected tool, the middle
/// one pans. Measurements can be dragged with any tool.
class PlaneTools {
public:
    PlaneTools(Document &document, mpr::Orientation orientation, ToolPane &pane);
    ~PlaneTools();

    /// Selects a tool and drops unfinished figures. A drag that has begun keeps its tool.
    void choose(Tool tool);
    /// The cursor of the selected tool.
    Qt::CursorShape cursor() const { return m_chosen->cursor(); }
    /// The cursor of the tool that the left button would use at this position.
    Qt::CursorShape cursorAt(const QPointF &at) const;

    /// A second button does not disturb the drag of the first.
    void press(Qt::MouseButton button, const QPointF &at);
    /// Returns false if no tool uses the move.
    bool move(const QPointF &at);
    /// The mouse leaves the pane.
    void leave();
    void release(Qt::MouseButton button, const QPointF &at);
    /// A double-click. Returns false if no tool uses it.
    bool doublePress(const QPointF &at);
    /// Ends a figure of any number of points. Returns false if there is none.
    bool finishFigure();
    /// The measurement at this position, or -1.
    int measurementAt(const QPointF &at) const;

    /// Whether something is unfinished that `cancel` would drop.
    bool isBusy() const;
    bool isMeasuring() const;
    /// Drops unfinished figures and ends the drag.
    void cancel();

    void moveCrosshair(const QPointF &at);

    /// Whether measurements can be seen, and thus dragged.
    void setMeasurementsShown(bool areShown) { m_showsMeasurements = areShown; }

    /// Draws the tools' marks on the pane.
    void paint(QPainter &painter, const ToolSurface &surface, const Overlays &shown) const;
    /// Draws the marks for an exported picture.
    void paintPlain(QPainter &painter, const ToolSurface &surface, Names names) const;

private:
    void add(Tool tool, std::unique_ptr<PaneTool> made);
    PaneTool *find(Tool tool) const;
    PaneTool &toolAt(const QPointF &at) const;
    void dropUnfinished();

    /// In painting order.
    std::vector<std::pair<Tool, std::unique_ptr<PaneTool>>> m_tools;
    MeasureTool *m_measure; ///< for every kind of measurement
    CrosshairTool *m_crosshair;
    PaneTool *m_chosen;
    PaneTool *m_activeTool = nullptr;        ///< gets the moves of the drag; null: nothing to drag
    Qt::MouseButton m_button = Qt::NoButton; ///< the button of the drag
    QPoint m_last;
    bool m_showsMeasurements = true;
};

} // namespace pellucid::ui
