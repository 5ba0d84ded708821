// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/classify/hand_marks.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/region_point.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Paints with a ball, or erases with it, as the option says; Shift swaps both. In a projection,
/// the ball is at the highest value on the line of sight. A drag is one edit.
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
    bool isBusy() const override { return !m_strokes.empty(); }
    void cancel() override { m_strokes.clear(); }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    void add(const QPointF &at);

    Document &m_document;
    const ToolPane &m_pane;
    const PaneView m_view;
    classify::Stroke m_new;                  ///< without a path
    std::vector<classify::Stroke> m_strokes; ///< of the present drag
    bool m_isInterrupted = true;             ///< the next point begins a stroke
    std::optional<QPointF> m_hovered;
};

} // namespace pellucid::ui
