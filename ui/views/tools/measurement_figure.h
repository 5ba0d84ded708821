// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QPolygonF>

#include "core/measure/measurement.h"
#include "ui/views/pane_mapping.h"

namespace pellucid::ui {

/// The places a hand can take a measurement by: its points, of a region the four corners of its
/// box. *Units*: mm, LPS.
std::vector<glm::dvec3> gripsOf(const measure::Measurement &measurement);

/// Moves one of them; of a region the corner becomes the second point and stays in its plane.
void moveGrip(measure::Measurement &measurement, int grip, const glm::dvec3 &toMm);

/// The outline on a pane, closed for regions. *Units*: logical pixels.
QPolygonF outlineOf(const measure::Measurement &measurement, const PaneMapping &mapping);

/// From a point to the nearest one between two others. *Units*: those of the points.
double distanceToSegment(const QPointF &point, const QPointF &from, const QPointF &to);

} // namespace pellucid::ui
