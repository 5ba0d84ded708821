// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/measure_tool.h"
#include "ui/views/tools/orbit_tool.h"
#include "ui/views/tools/pan_tool.h"
#include "ui/views/tools/tone_tool.h"
#include "ui/views/tools/tool.h"

namespace pellucid::ui {

/// The tools of the projection and the drag that is underway. The left button orbits, the middle
/// one pans, the right one sets the brightness; of the tools that are chosen only that of distances
/// matters. What is measured can be dragged whichever is chosen.
class ProjectionTools {
public:
    ProjectionTools(Document &document, ProjectionPane &pane);

    /// Drops what is half measured.
    void choose(Tool tool);
    /// That of the chosen tool; none: the pane's own.
    std::optional<Qt::CursorShape> cursor() const;
    /// That of the drag.
    Qt::CursorShape heldCursor() const;

    /// A second button takes the drag over, unless something is being measured.
    void press(Qt::MouseButton button, const QPointF &at);
    void move(const QPointF &at);
    /// Any button ends the drag; only the left one what is being measured.
    void release(Qt::MouseButton button, const QPointF &at);

    bool isMeasuring() const { return m_measure.isBusy(); }
    /// Drops what is half measured.
    void cancel() { m_measure.cancel(); }

    /// What draws the measurements.
    const PaneTool &measure() const { return m_measure; }

private:
    PaneTool *toolOf(Qt::MouseButton button);

    const ProjectionPane &m_pane;
    MeasureTool m_measure;
    OrbitTool m_orbit;
    PanTool m_pan;
    ToneTool m_tone;
    bool m_measures = false;
    PaneTool *m_held = nullptr; ///< gets the moves of the drag
    QPoint m_last;
};

} // namespace pellucid::ui
