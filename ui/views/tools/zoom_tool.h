// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Zooms: dragging up enlarges the picture.
class ZoomTool : public PaneTool {
public:
    explicit ZoomTool(ToolPane &pane) : m_pane(pane) {}

    Qt::CursorShape cursor() const override { return Qt::SizeVerCursor; }
    bool press(const QPointF & /*at*/) override { return true; }
    bool move(const MouseMove &mouse) override;

private:
    ToolPane &m_pane;
};

} // namespace pellucid::ui
