// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/region_point.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Marks what is connected with a click and has similar values. Dragging up accepts more values,
/// dragging down fewer; the planes show the region meanwhile. In a projection, the click means the
/// highest value on the line of sight.
class GrowTool : public PaneTool {
public:
    GrowTool(Document &document, const ToolPane &pane, PaneView view)
        : m_document(document), m_pane(pane), m_view(view) {}

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    bool isBusy() const override { return m_isDragging; }
    void cancel() override;
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    classify::TissueClass region() const;
    void seek();

    Document &m_document;
    const ToolPane &m_pane;
    const PaneView m_view;
    bool m_isDragging = false;
    volume::PatientPoint m_point;
    double m_value = 0.0;   ///< there
    double m_spread = 0.0;  ///< of the values around it
    double m_dragged = 0.0; ///< upwards since the press, logical pixels
};

} // namespace pellucid::ui
