// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Turns the projection; with Alt or Shift, rolls it.
class OrbitTool : public PaneTool {
public:
    OrbitTool(const ToolPane &pane, ProjectionPane &projection)
        : m_pane(pane), m_projection(projection) {}

    Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
    Qt::CursorShape heldCursor() const override { return Qt::ClosedHandCursor; }
    bool press(const QPointF & /*at*/) override { return true; }
    bool move(const MouseMove &mouse) override;

private:
    const ToolPane &m_pane;
    ProjectionPane &m_projection;
};

} // namespace pellucid::ui
