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

/// A mouse move on a pane. *Units*: logical pixels of the pane.
struct MouseMove {
    QPointF at;
    QPoint delta; ///< since the last event
};

/// How much a tool draws.
enum class Marks {
    nameless, ///< for an exported picture without identity: also without typed texts
    plain,    ///< for an exported picture: without handles
    shown,    ///< on the pane, while a different tool is selected
    chosen
};

/// The surface that a tool draws on: a pane, or a picture of its size.
struct ToolSurface {
    PaneMapping mapping;
    QRect area;
    OverlayColors colors;
};

/// The action of a mouse button in a pane. A drag is a press, moves and a release; the pane
/// repaints after each.
class PaneTool {
public:
    virtual ~PaneTool() = default;

    /// The cursor while the tool is selected.
    virtual Qt::CursorShape cursor() const = 0;
    /// The cursor during its drag.
    virtual Qt::CursorShape heldCursor() const { return cursor(); }
    /// The cursor over something that this tool can drag; none elsewhere.
    virtual std::optional<Qt::CursorShape> gripCursor(const QPointF & /*at*/) const {
        return std::nullopt;
    }

    /// Returns false if there is nothing to drag here; the tool then gets neither moves nor the
    /// release.
    virtual bool press(const QPointF &at) = 0;
    /// Returns false if the drag is over although the button is down, as after `cancel`.
    virtual bool move(const MouseMove &mouse) = 0;
    /// Ends the drag and keeps its result.
    virtual void release(const QPointF & /*at*/) {}

    /// The mouse moves over the pane without a button, or leaves it. `hover` returns whether the
    /// pane has to repaint.
    virtual bool hover(const QPointF & /*at*/) { return false; }
    virtual void leave() {}

    /// Whether something is unfinished that `cancel` would drop.
    virtual bool isBusy() const { return false; }
    /// Drops an unfinished figure; a dragged one stays where it is.
    virtual void cancel() {}

    virtual void paint(QPainter & /*painter*/, const ToolSurface & /*surface*/,
                       Marks /*marks*/) const {}
};

} // namespace pellucid::ui
