// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"

namespace pellucid::ui {

class Document;

/// Sets the display window of the planes: drag left and right for its width, up and down for its
/// center.
class WindowTool : public PaneTool {
public:
    explicit WindowTool(Document &document) : m_document(document) {}

    Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;

private:
    Document &m_document;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
