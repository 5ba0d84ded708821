// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Sets the brightness of the projection: to the side its range, up and down the middle of that.
class ToneTool : public PaneTool {
public:
    ToneTool(Document &document, const ProjectionPane &pane) : m_document(document), m_pane(pane) {}

    Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
    bool press(const QPointF &at) override;
    bool move(const HandMove &hand) override;

private:
    Document &m_document;
    const ProjectionPane &m_pane;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
