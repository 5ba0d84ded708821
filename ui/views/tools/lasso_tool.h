// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPolygonF>

#include "core/classify/hand_marks.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

class Document;

/// Cuts along the line of sight what the drawn line encloses.
class LassoTool : public PaneTool {
public:
    LassoTool(Document &document, const ToolPane &pane) : m_document(document), m_pane(pane) {}

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    bool isBusy() const override { return !m_cut.outline.empty(); }
    void cancel() override { m_cut = {}; }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    QPolygonF outlineOn(const PaneMapping &mapping) const;

    Document &m_document;
    const ToolPane &m_pane;
    classify::LassoCut m_cut; ///< while it is drawn: the pane may be moved or zoomed meanwhile
};

} // namespace pellucid::ui
