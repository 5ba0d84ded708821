// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Sets the window of the projection: drag left and right for its width, up and down for its
/// center.
class ToneTool : public PaneTool {
public:
    ToneTool(Document &document, const ProjectionPane &pane) : m_document(document), m_pane(pane) {}

    Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;

private:
    Document &m_document;
    const ProjectionPane &m_pane;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
