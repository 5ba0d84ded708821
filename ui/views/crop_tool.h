// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QPointF>

#include "core/classify/crop_box.h"
#include "core/mpr/box_outline.h"
#include "ui/views/overlay.h"
#include "ui/views/pane_mapping.h"

class QPainter;

namespace pellucid::ui {

class Document;

/// The crop box in a pane: its faces are lines that can be dragged; what is outside is dimmed. The
/// scene changes when the hand lets go, because everything is prepared again then.
class CropTool {
public:
    explicit CropTool(Document &document) : m_document(document) {}

    /// False if no line is there.
    bool press(const PaneMapping &pane, const QPointF &at);
    void move(const PaneMapping &pane, const QPointF &at);
    void release();
    void cancel() { m_dragged.reset(); }
    bool isBusy() const { return m_dragged.has_value(); }
    /// The cursor over a line that can be dragged; none elsewhere.
    std::optional<Qt::CursorShape> cursorAt(const PaneMapping &pane, const QPointF &at) const;

    /// `withLines`: they can be taken. What is left out is dimmed in any case.
    void paint(QPainter &painter, const PaneMapping &pane, const QRect &area, bool withLines,
               const OverlayColors &colors) const;

private:
    struct Face {
        int axis;
        bool isHigh;
    };
    const classify::CropBox &shown() const;
    std::vector<mpr::BoxEdge> outline(const PaneMapping &pane) const;
    std::optional<mpr::BoxEdge> edgeAt(const PaneMapping &pane, const QPointF &at) const;

    Document &m_document;
    std::optional<Face> m_dragged;
    classify::CropBox m_moved; ///< while a face is dragged
};

} // namespace pellucid::ui
