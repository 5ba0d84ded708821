// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mpr/plane.h"
#include "ui/document/commands.h"
#include "ui/views/crosshair.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Moves the crosshair in a plane, and turns the two other planes by the handles of their lines.
class CrosshairTool : public PaneTool {
public:
    CrosshairTool(Document &document, const ToolPane &pane, mpr::Orientation orientation)
        : m_document(document), m_pane(pane), m_orientation(orientation) {}

    /// Moves the crosshair to a position. *Units*: logical pixels of the pane.
    void moveTo(const QPoint &to);

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    std::optional<Qt::CursorShape> gripCursor(const QPointF &at) const override;
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    CrosshairLines lines(const PaneMapping &mapping) const;
    void turnTo(const QPoint &to);

    Document &m_document;
    const ToolPane &m_pane;
    const mpr::Orientation m_orientation;
    bool m_isTurning = false;
    double m_turnAngle = 0.0;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
