// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointF>

#include "core/mpr/plane.h"

namespace pellucid::ui {

/// Maps positions on a widget to points in the patient, and back. *Units*: the plane is in device
/// pixels, positions are in logical pixels.
struct PaneMapping {
    mpr::Plane plane;
    double pixelRatio = 1.0;

    volume::PatientPoint patientAt(const QPointF &position) const {
        return plane.at(position.x() * pixelRatio - 0.5, position.y() * pixelRatio - 0.5);
    }
    QPointF positionOf(volume::PatientPoint point) const {
        const glm::dvec2 pixel = plane.pixel(point);
        return QPointF(pixel.x + 0.5, pixel.y + 0.5) / pixelRatio;
    }
    /// *Units*: logical pixels per mm.
    double pixelsPerMm() const { return 1.0 / (plane.pixelMm * pixelRatio); }
};

} // namespace pellucid::ui
