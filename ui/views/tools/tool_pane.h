// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPoint>
#include <QSize>

#include "core/picture/compose.h"
#include "core/scene/scene.h"
#include "ui/views/pane_mapping.h"

namespace pellucid::ui {

/// A pane as its tools know it.
class ToolPane {
public:
    /// Between places on the pane, as it is now, and in the patient.
    virtual PaneMapping mapping() const = 0;
    /// *Units*: logical pixels.
    virtual QSize paneSize() const = 0;
    /// How far from the plane, on either side, a point counts as in it.
    virtual double reachMm() const = 0;
    /// The picture follows the hand. *Units*: logical pixels.
    virtual void panBy(const QPoint &delta) = 0;
    /// Above 1: the picture becomes larger about the middle of the pane.
    virtual void zoomBy(double factor) = 0;

protected:
    ~ToolPane() = default;
};

/// The projection as its tools know it.
class ProjectionPane : public ToolPane {
public:
    /// A picture is shown.
    virtual bool showsPicture() const = 0;
    /// An engine is there, so that the view can be moved.
    virtual bool canMove() const = 0;
    /// The side that faces the viewer follows the hand. *Units*: logical pixels.
    virtual void orbitBy(const QPoint &delta) = 0;
    /// The brightness that was taken from the picture.
    virtual const picture::ToneRange &automaticTone() const = 0;
    /// The brightness that is shown, with both ends.
    virtual scene::Tone shownTone() const = 0;

protected:
    ~ProjectionPane() = default;
};

} // namespace pellucid::ui
