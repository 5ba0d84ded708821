// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/camera_moves.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace pellucid::ui {

namespace {

constexpr double radiansPerPixel = 0.008;

glm::dvec2 onPicture(const glm::dmat3 &axes, const glm::dvec3 &mm) {
    return {glm::dot(axes[0], mm), glm::dot(axes[1], mm)};
}

} // namespace

scene::Camera turnedTo(const scene::Camera &camera, const glm::dquat &orientation,
                       const glm::dvec3 &pivotMm) {
    scene::Camera turned = camera;
    turned.orientation = glm::normalize(orientation);
    // A point is seen at its foot on the picture less the pan.
    turned.panMm += onPicture(turned.axes(), pivotMm) - onPicture(camera.axes(), pivotMm);
    return turned;
}

glm::dvec2 pannedTo(const scene::Camera &camera, const glm::dvec3 &shownMm,
                    const glm::dvec3 &pointMm) {
    return camera.panMm + onPicture(camera.axes(), pointMm - shownMm);
}

scene::Camera orbited(const scene::Camera &camera, const QPoint &delta, const glm::dvec3 &pivotMm) {
    // The camera turns the other way.
    const glm::dquat turn = glm::angleAxis(-radiansPerPixel * delta.x(), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(-radiansPerPixel * delta.y(), glm::dvec3(1, 0, 0));
    return turnedTo(camera, camera.orientation * turn, pivotMm);
}

scene::Camera turnedAroundPatient(const scene::Camera &camera, double degrees,
                                  const glm::dvec3 &pivotMm) {
    return turnedTo(camera,
                    glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1)) * camera.orientation,
                    pivotMm);
}

scene::Camera panned(const scene::Camera &camera, const QPoint &delta, double pixelRatio) {
    scene::Camera moved = camera;
    const double mm = camera.pixelMm * pixelRatio;
    moved.panMm += glm::dvec2(-delta.x() * mm, delta.y() * mm);
    return moved;
}

} // namespace pellucid::ui
