// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QPoint>
#include <QPointF>
#include <QRect>

#include "ui/views/overlay.h"
#include "ui/views/pane_mapping.h"

class QPainter;

namespace pellucid::ui {

/// Where the hand is on a pane. *Units*: logical pixels of the pane.
struct HandMove {
    QPointF at;
    QPoint delta; ///< since the last event
};

/// How much of itself a tool draws.
enum class Marks {
    plain, ///< what belongs to an exported picture: nothing that the hand takes hold of
    shown, ///< on the pane, while another tool is chosen
    chosen
};

/// What a tool draws on: a pane as it is shown, or a picture of its size.
struct ToolSurface {
    PaneMapping mapping;
    QRect area;
    OverlayColors colors;
};

/// What a mouse button does in a pane. A drag is a press, moves and a release. The pane repaints
/// after each of them.
class PaneTool {
public:
    virtual ~PaneTool() = default;

    /// The cursor while the tool is chosen.
    virtual Qt::CursorShape cursor() const = 0;
    /// The cursor over something of the tool's own that can be dragged; none elsewhere.
    virtual std::optional<Qt::CursorShape> gripCursor(const QPointF & /*at*/) const {
        return std::nullopt;
    }

    /// False: there is nothing to drag here, and the tool gets neither moves nor the release.
    virtual bool press(const QPointF &at) = 0;
    /// False: the drag is over though the button is down, as after `cancel`.
    virtual bool move(const HandMove &hand) = 0;
    /// Ends the drag and keeps what it made.
    virtual void release(const QPointF & /*at*/) {}

    /// Something is half done that `cancel` ends.
    virtual bool isBusy() const { return false; }
    /// Drops what is half made; what is dragged stays where it is.
    virtual void cancel() {}

    virtual void paint(QPainter & /*painter*/, const ToolSurface & /*surface*/,
                       Marks /*marks*/) const {}
};

} // namespace pellucid::ui
