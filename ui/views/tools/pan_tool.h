// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Pans the picture.
class PanTool : public PaneTool {
public:
    PanTool(ToolPane &pane, Qt::CursorShape cursor) : m_pane(pane), m_cursor(cursor) {}

    Qt::CursorShape cursor() const override { return m_cursor; }
    bool press(const QPointF & /*at*/) override { return true; }
    bool move(const MouseMove &mouse) override;

private:
    ToolPane &m_pane;
    const Qt::CursorShape m_cursor;
};

} // namespace pellucid::ui
