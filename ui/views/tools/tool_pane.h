// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QPoint>
#include <QPointF>
#include <QSize>
#include <QString>

#include "core/picture/display.h"
#include "core/scene/scene.h"
#include "ui/views/pane_mapping.h"

namespace pellucid::ui {

/// The interface of a pane to its tools.
class ToolPane {
public:
    /// The current mapping between positions on the pane and in the patient.
    virtual PaneMapping mapping() const = 0;
    /// *Units*: logical pixels.
    virtual QSize paneSize() const = 0;
    /// The distance on either side within which a point counts as in the plane.
    virtual double reachMm() const = 0;
    /// Moves the picture. *Units*: logical pixels.
    virtual void panBy(const QPoint &delta) = 0;
    /// Scales the picture about the center of the pane; above 1 enlarges it.
    virtual void zoomBy(double factor) = 0;
    /// Lets the user type a text on the pane; `take` gets it without spaces at its ends, unless the
    /// user presses Escape.
    virtual void askForText(const QPointF &at, const QString &text,
                            const std::function<void(const QString &)> &take) = 0;

protected:
    ~ToolPane() = default;
};

/// The interface of the projection to the tools that only it has.
class ProjectionPane {
public:
    /// Rotates the view so that the near side follows the mouse. *Units*: logical pixels.
    virtual void orbitBy(const QPoint &delta) = 0;
    /// Rolls the picture clockwise.
    virtual void rollBy(double radians) = 0;
    /// The range that the exposure gives.
    virtual picture::ToneRange automaticRange() const = 0;
    /// The current one.
    virtual picture::ToneRange shownRange() const = 0;

protected:
    ~ProjectionPane() = default;
};

} // namespace pellucid::ui
