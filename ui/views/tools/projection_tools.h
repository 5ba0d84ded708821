// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/grow_tool.h"
#include "ui/views/tools/lasso_tool.h"
#include "ui/views/tools/measure_tool.h"
#include "ui/views/tools/orbit_tool.h"
#include "ui/views/tools/paint_tool.h"
#include "ui/views/tools/pan_tool.h"
#include "ui/views/tools/tone_tool.h"
#include "ui/views/tools/tool.h"
#include "ui/views/tools/zoom_tool.h"

namespace pellucid::ui {

/// The tools of the projection and the current drag. The left button orbits, the middle one pans,
/// the right one sets the brightness. Of the selectable tools, those that pan and zoom, measure in
/// one plane, annotate or mark regions have an effect here. Measurements can be dragged with any
/// tool.
class ProjectionTools {
public:
    ProjectionTools(Document &document, ProjectionPane &pane);

    /// Selects a tool and drops what is unfinished.
    void choose(Tool tool);
    /// The cursor of the selected tool; none: the pane's own.
    std::optional<Qt::CursorShape> cursor() const;
    /// The cursor of the current drag.
    Qt::CursorShape heldCursor() const;

    /// A second button takes over the drag, unless a measurement is unfinished.
    void press(Qt::MouseButton button, const QPointF &at);
    void move(const QPointF &at);
    /// The mouse moves without a button. Returns whether the pane has to repaint.
    bool hover(const QPointF &at);
    void leave();
    /// Any button ends the drag; only the left one ends a measurement or a region.
    void release(Qt::MouseButton button, const QPointF &at);

    /// A double-click. Returns false if no tool uses it.
    bool doublePress(const QPointF &at);
    /// Ends a figure of any number of points. Returns false if there is none.
    bool finishFigure();
    /// The measurement at this position, or -1.
    int measurementAt(const QPointF &at) const;
    /// Whether measurements can be seen, and thus dragged.
    void setMeasurementsShown(bool areShown) { m_showsMeasurements = areShown; }

    /// Whether the selected tool marks regions.
    bool marksRegions() const { return m_region != nullptr; }
    /// Whether the left button marks something that is unfinished.
    bool isMarking() const;
    bool isMeasuring() const { return m_measure.isBusy(); }
    /// Drops what is unfinished.
    void cancel();

    /// Draws the measurements, and what is being marked.
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const;

private:
    PaneTool *toolOf(Qt::MouseButton button);

    const ProjectionPane &m_pane;
    MeasureTool m_measure;
    OrbitTool m_orbit;
    PanTool m_pan;
    ZoomTool m_zoom;
    ToneTool m_tone;
    GrowTool m_grow;
    PaintTool m_paint;
    LassoTool m_lasso;
    PaneTool *m_region = nullptr; ///< the selected tool for regions
    PaneTool *m_left = &m_orbit;  ///< what the left button does otherwise
    bool m_measures = false, m_showsMeasurements = true;
    PaneTool *m_activeTool = nullptr; ///< gets the moves of the drag
    QPoint m_last;
};

} // namespace pellucid::ui
