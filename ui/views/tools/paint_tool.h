// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/classify/hand_marks.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/region_point.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Paints with a ball, or erases with it: by the option, and with Shift the other way. In a
/// projection, the ball is at the highest value on the line of sight.
class PaintTool : public PaneTool {
public:
    PaintTool(Document &document, const ToolPane &pane, PaneView view)
        : m_document(document), m_pane(pane), m_view(view) {}

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    bool hover(const QPointF &at) override;
    void leave() override { m_hovered.reset(); }
    bool isBusy() const override { return !m_stroke.path.empty(); }
    void cancel() override { m_stroke.path.clear(); }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    void add(const QPointF &at);

    Document &m_document;
    const ToolPane &m_pane;
    const PaneView m_view;
    classify::Stroke m_stroke; ///< while it is drawn
    std::optional<QPointF> m_hovered;
};

} // namespace pellucid::ui
