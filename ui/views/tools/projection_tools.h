// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/measure_tool.h"
#include "ui/views/tools/orbit_tool.h"
#include "ui/views/tools/pan_tool.h"
#include "ui/views/tools/tone_tool.h"
#include "ui/views/tools/tool.h"

namespace pellucid::ui {

/// The tools of the projection and the current drag. The left button orbits, the middle one pans,
/// the right one sets the brightness. Of the selectable tools, only the distance tool has an effect
/// here. Measurements can be dragged with any tool.
class ProjectionTools {
public:
    ProjectionTools(Document &document, ProjectionPane &pane);

    /// Selects a tool and drops an unfinished measurement.
    void choose(Tool tool);
    /// The cursor of the selected tool; none: the pane's own.
    std::optional<Qt::CursorShape> cursor() const;
    /// The cursor of the current drag.
    Qt::CursorShape heldCursor() const;

    /// A second button takes over the drag, unless a measurement is unfinished.
    void press(Qt::MouseButton button, const QPointF &at);
    void move(const QPointF &at);
    /// Any button ends the drag; only the left one ends a measurement.
    void release(Qt::MouseButton button, const QPointF &at);

    bool isMeasuring() const { return m_measure.isBusy(); }
    /// Drops an unfinished measurement.
    void cancel() { m_measure.cancel(); }

    /// The tool that draws the measurements.
    const PaneTool &measure() const { return m_measure; }

private:
    PaneTool *toolOf(Qt::MouseButton button);

    const ProjectionPane &m_pane;
    MeasureTool m_measure;
    OrbitTool m_orbit;
    PanTool m_pan;
    ToneTool m_tone;
    bool m_measures = false;
    PaneTool *m_activeTool = nullptr; ///< gets the moves of the drag
    QPoint m_last;
};

} // namespace pellucid::ui
