// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QSize>

#include "core/mpr/plane.h"
#include "ui/views/pane_mapping.h"

class QPainter;

namespace pellucid::ui {

/// The intersections of a pane with the two other planes, as lines through the crosshair.
class CrosshairLines {
public:
    CrosshairLines(const PaneMapping &mapping, volume::PatientPoint crosshair,
                   const mpr::PlaneAxes &axes, mpr::Orientation pane);

    /// `withHandles`: draws handles, by which the lines can be turned.
    void paint(QPainter &painter, const QSize &size, bool withHandles) const;
    /// Whether a handle is at this position.
    bool isHandleAt(const QPointF &position, const QSize &size) const;
    /// The angle of a position about the crosshair, counterclockwise. *Units*: rad.
    double angleAt(const QPointF &position) const;

private:
    struct Line {
        mpr::Orientation plane;
        QPointF direction; ///< of length 1
    };
    std::array<QPointF, 2> handles(const Line &line, const QSize &size) const;

    QPointF m_at;
    std::array<Line, 2> m_lines;
};

/// The color role of a plane.
const char *colorRole(mpr::Orientation orientation);

} // namespace pellucid::ui
