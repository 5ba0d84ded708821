// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPoint>

#include <glm/vec3.hpp>

#include "ui/document/pose.h"

namespace pellucid::ui {

/// Moves of the camera by hand. Turning leaves the pivot, a point of the patient, at its place in
/// the picture. *Units*: `pivotMm`: LPS, from the middle of the volume, which is 0.
Pose turnedTo(const Pose &pose, const glm::dquat &orientation, const glm::dvec3 &pivotMm);
/// As on a turntable, so that the patient stays upright: about the patient's long axis, and up to
/// the poles. *Units*: `delta`: logical pixels.
Pose turnedByTable(const Pose &pose, const QPoint &delta, const glm::dvec3 &pivotMm);
/// About the line of sight.
Pose rolled(const Pose &pose, double radians, const glm::dvec3 &pivotMm);
/// As a trackball: the side that faces the viewer follows the hand, in every direction.
Pose orbited(const Pose &pose, const QPoint &delta, const glm::dvec3 &pivotMm);
/// Turns about the patient's long axis.
Pose turnedAroundPatient(const Pose &pose, double degrees, const glm::dvec3 &pivotMm);
/// The pan that shows `pointMm` where the pose shows `shownMm`. *Units*: mm, each from the middle
/// of its volume.
glm::dvec2 pannedTo(const Pose &pose, const glm::dvec3 &shownMm, const glm::dvec3 &pointMm);
/// The picture follows the hand. *Units*: `delta`: logical pixels of `pixelMm`.
Pose panned(const Pose &pose, const QPoint &delta, double pixelMm);
/// Above 1: the picture becomes larger.
Pose zoomed(const Pose &pose, double factor);

} // namespace pellucid::ui
