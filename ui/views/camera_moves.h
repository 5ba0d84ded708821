// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPoint>

#include <glm/vec3.hpp>

#include "core/scene/camera.h"

namespace pellucid::ui {

/// Cameras that a hand has moved. Turning keeps one point of the patient where it is in the
/// picture. *Units*: `pivotMm`: from the middle of the volume, LPS; 0: about the middle.
scene::Camera turnedTo(const scene::Camera &camera, const glm::dquat &orientation,
                       const glm::dvec3 &pivotMm);
/// The side that faces the viewer follows the hand. *Units*: logical pixels.
scene::Camera orbited(const scene::Camera &camera, const QPoint &delta, const glm::dvec3 &pivotMm);
scene::Camera turnedAroundPatient(const scene::Camera &camera, double degrees,
                                  const glm::dvec3 &pivotMm);
/// The pan that shows a point where a camera shows another one, *units*: mm, both from the middle
/// of their volumes.
glm::dvec2 pannedTo(const scene::Camera &camera, const glm::dvec3 &shownMm,
                    const glm::dvec3 &pointMm);
/// *Units*: `delta`: logical pixels, `pixelRatio`: device pixels in one of them.
scene::Camera panned(const scene::Camera &camera, const QPoint &delta, double pixelRatio);

} // namespace pellucid::ui
