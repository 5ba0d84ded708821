// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/region_point.h"
#include "ui/views/tools/tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;
class MeasureTool;

/// The tools of a pane and the current drag. The left button uses the selected tool, the middle one
/// pans. Measurements can be dragged with any tool. Every pane pans, zooms, measures and marks
/// regions; it adds what only it can do.
class PaneTools {
public:
    PaneTools(Document &document, ToolPane &pane, PaneView view);
    ~PaneTools();

    /// Adds a tool, whose marks are painted below those of the others.
    void add(Tool tool, std::unique_ptr<PaneTool> made);
    /// What the left button does if the pane has no use for the selected tool, or with Ctrl.
    void addTurning(std::unique_ptr<PaneTool> made) { m_turning = std::move(made); }
    /// What the right button does.
    void addRight(std::unique_ptr<PaneTool> made) { m_right = std::move(made); }

    /// Selects a tool and drops unfinished figures. A drag that has begun keeps its tool.
    void choose(Tool tool);
    /// Whether the selected tool marks regions.
    bool marksRegions() const { return ui::marksRegions(m_selected); }
    /// The cursor of the current drag or, without one, of what the left button would use here.
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
    /// Drops unfinished figures. A drag goes on.
    void dropUnfinished();
    /// Drops them and ends the drag.
    void cancel();

    /// Whether measurements can be seen, and thus dragged.
    void setMeasurementsShown(bool areShown) { m_showsMeasurements = areShown; }

    /// Draws the tools' marks: on the pane, those of the overlays that are shown and of the
    /// selected tool; for an exported picture (`marks` up to `plain`), all.
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks,
               const Overlays &shown) const;

private:
    PaneTool *find(Tool tool) const;
    PaneTool &toolAt(const QPointF &at) const;
    PaneTool *toolOf(Qt::MouseButton button, const QPointF &at) const;

    const PaneView m_view;
    /// In painting order.
    std::vector<std::pair<Tool, std::unique_ptr<PaneTool>>> m_tools;
    std::unique_ptr<PaneTool> m_turning, m_right; ///< may be null
    MeasureTool *m_measure;                       ///< for every kind of measurement
    Tool m_selected = Tool::pan;
    PaneTool *m_chosen;
    PaneTool *m_activeTool = nullptr; ///< gets the moves of the drag; null: nothing to drag
    std::optional<Qt::CursorShape> m_gripCursor; ///< of what is dragged
    Qt::MouseButton m_button = Qt::NoButton;     ///< the button of the drag
    QPoint m_last;
    bool m_showsMeasurements = true;
};

} // namespace pellucid::ui
