// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/camera_moves.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace pellucid::ui {

namespace {

constexpr double radiansPerPixel = 0.008;

// The foot of a point on the plane of the picture.
glm::dvec2 onPicture(const glm::dquat &orientation, const glm::dvec3 &mm) {
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    return {glm::dot(axes[0], mm), glm::dot(axes[1], mm)};
}

} // namespace

Pose turnedTo(const Pose &pose, const glm::dquat &orientation, const glm::dvec3 &pivotMm) {
    Pose turned = pose;
    turned.orientation = glm::normalize(orientation);
    // The picture shows a point at its foot minus the pan.
    turned.panMm += onPicture(turned.orientation, pivotMm) - onPicture(pose.orientation, pivotMm);
    return turned;
}

glm::dvec2 pannedTo(const Pose &pose, const glm::dvec3 &shownMm, const glm::dvec3 &pointMm) {
    return pose.panMm + onPicture(pose.orientation, pointMm - shownMm);
}

Pose orbited(const Pose &pose, const QPoint &delta, const glm::dvec3 &pivotMm) {
    // The camera turns against the hand.
    const glm::dquat turn = glm::angleAxis(-radiansPerPixel * delta.x(), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(-radiansPerPixel * delta.y(), glm::dvec3(1, 0, 0));
    return turnedTo(pose, pose.orientation * turn, pivotMm);
}

Pose turnedAroundPatient(const Pose &pose, double degrees, const glm::dvec3 &pivotMm) {
    return turnedTo(pose,
                    glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1)) * pose.orientation,
                    pivotMm);
}

Pose panned(const Pose &pose, const QPoint &delta, double pixelMm) {
    Pose moved = pose;
    moved.panMm += glm::dvec2(-delta.x() * pixelMm, delta.y() * pixelMm);
    return moved;
}

Pose zoomed(const Pose &pose, double factor) {
    Pose closer = pose;
    closer.zoom *= factor;
    return closer;
}

} // namespace pellucid::ui
