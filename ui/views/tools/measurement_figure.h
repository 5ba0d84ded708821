// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QPolygonF>

#include "core/measure/measurement.h"
#include "ui/views/pane_mapping.h"

namespace pellucid::ui {

/// The grips of a measurement: its points or, for a region, the four corners of its box. *Units*:
/// mm, LPS.
std::vector<glm::dvec3> gripsOf(const measure::Measurement &measurement);

/// Moves a grip. For a region, the corner becomes the second point and stays in the region's plane.
void moveGrip(measure::Measurement &measurement, int grip, const glm::dvec3 &toMm);

/// The lines on a pane: one for most kinds, closed for regions; two for a Cobb angle; none for a
/// text. *Units*: logical pixels.
std::vector<QPolygonF> outlinesOf(const measure::Measurement &measurement,
                                  const PaneMapping &mapping);

/// The two strokes of an arrow's head, with the tip in the middle; empty for other kinds.
QPolygonF arrowHeadOf(const measure::Measurement &measurement, const PaneMapping &mapping);

/// The distance from a point to a line segment. *Units*: those of the points.
double distanceToSegment(const QPointF &point, const QPointF &from, const QPointF &to);

} // namespace pellucid::ui
