// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/classify/crop_box.h"
#include "core/mpr/box_outline.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Shows the crop box in a plane and lets its faces be dragged. The outside is dimmed with any
/// tool. The scene changes only on release, because each change requires a new preparation.
class CropTool : public PaneTool {
public:
    CropTool(Document &document, const ToolPane &pane) : m_document(document), m_pane(pane) {}

    Qt::CursorShape cursor() const override { return Qt::ArrowCursor; }
    std::optional<Qt::CursorShape> gripCursor(const QPointF &at) const override;
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    bool isBusy() const override { return m_dragged.has_value(); }
    /// Restores the box.
    void cancel() override { m_dragged.reset(); }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    struct Face {
        int axis;
        bool isHigh;
    };
    const classify::CropBox &shown() const;
    std::vector<mpr::BoxEdge> outline(const PaneMapping &mapping) const;
    std::optional<mpr::BoxEdge> edgeAt(const QPointF &at) const;
    void paintSides(QPainter &painter, const ToolSurface &surface,
                    const std::vector<mpr::BoxEdge> &edges, Marks marks) const;

    Document &m_document;
    const ToolPane &m_pane;
    std::optional<Face> m_dragged;
    classify::CropBox m_moved; ///< the box while a face is dragged
};

} // namespace pellucid::ui
