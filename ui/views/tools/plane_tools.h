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

/// The tools of a plane and the drag that is underway. The left button works with the chosen tool,
/// the middle one pans, and what is measured can be dragged whichever tool is chosen.
class PlaneTools {
public:
    PlaneTools(Document &document, mpr::Orientation orientation, ToolPane &pane);
    ~PlaneTools();

    /// Drops what is half done; a drag that has begun keeps its tool.
    void choose(Tool tool);
    /// That of the chosen tool.
    Qt::CursorShape cursor() const { return m_chosen->cursor(); }
    /// That of the tool which the left button would use there.
    Qt::CursorShape cursorAt(const QPointF &at) const;

    /// A second button does not disturb what the first one drags.
    void press(Qt::MouseButton button, const QPointF &at);
    /// False: no tool wants the move.
    bool move(const QPointF &at);
    void release(Qt::MouseButton button, const QPointF &at);

    /// Something is half done that `cancel` ends.
    bool isBusy() const;
    bool isMeasuring() const;
    /// Drops what is half done and ends the drag.
    void cancel();

    void moveCrosshair(const QPointF &at);

    /// Draws what the tools show on the pane.
    void paint(QPainter &painter, const ToolSurface &surface) const;
    /// Draws what of it belongs to an exported picture.
    void paintPlain(QPainter &painter, const ToolSurface &surface) const;

private:
    void add(Tool tool, std::unique_ptr<PaneTool> made);
    PaneTool *find(Tool tool) const;
    PaneTool &toolAt(const QPointF &at) const;
    void dropHalfDone();

    /// In the order in which they are painted.
    std::vector<std::pair<Tool, std::unique_ptr<PaneTool>>> m_tools;
    MeasureTool *m_measure; ///< whatever is measured
    CrosshairTool *m_crosshair;
    PaneTool *m_chosen;
    PaneTool *m_held = nullptr; ///< gets the moves of the drag; none: it found nothing to drag
    Qt::MouseButton m_button = Qt::NoButton; ///< of the drag
    QPoint m_last;
};

} // namespace pellucid::ui
