// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/camera_moves.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
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

Pose turnedByTable(const Pose &pose, const QPoint &delta, const glm::dvec3 &pivotMm) {
    const glm::dmat3 axes = glm::mat3_cast(pose.orientation);
    // Upside down, the near side would otherwise turn against the hand.
    const double way = axes[1].z < 0.0 ? 1.0 : -1.0;
    const double around = way * radiansPerPixel * delta.x();
    // Up to the poles and no further. Only where the picture is upright does this mean anything.
    double over = -radiansPerPixel * delta.y();
    constexpr double upright = 0.02;
    if (std::abs(axes[0].z) < upright && axes[1].z > -upright) {
        const double elevation = std::asin(std::clamp(axes[2].z, -1.0, 1.0));
        // A turn about the picture's right by `over` lowers the line of sight by as much.
        over = elevation -
               std::clamp(elevation - over, -glm::half_pi<double>(), glm::half_pi<double>());
    }
    return turnedTo(pose,
                    glm::angleAxis(around, glm::dvec3(0, 0, 1)) * pose.orientation *
                        glm::angleAxis(over, glm::dvec3(1, 0, 0)),
                    pivotMm);
}

Pose rolled(const Pose &pose, double radians, const glm::dvec3 &pivotMm) {
    return turnedTo(pose, pose.orientation * glm::angleAxis(radians, glm::dvec3(0, 0, 1)), pivotMm);
}

Pose orbited(const Pose &pose, const QPoint &delta, const glm::dvec3 &pivotMm) {
    // The camera turns against the hand.
    const glm::dquat turn = glm::angleAxis(-radiansPerPixel * delta.x(), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(-radiansPerPixel * delta.y(), glm::dvec3(1, 0, 0));
    return turnedTo(pose, pose.orientation * turn, pivotMm);
}

Pose turnedAroundPatient(const Pose &pose, double degrees, const glm::dvec3 &pivotMm) {
    return turnedTo(pose, scene::turnedAboutLongAxis(pose.orientation, degrees), pivotMm);
}

Pose panned(const Pose &pose, const QPoint &delta, double pixelMm) {
    Pose moved = pose;
    moved.isFitted = false;
    moved.panMm += glm::dvec2(-delta.x() * pixelMm, delta.y() * pixelMm);
    return moved;
}

Pose zoomed(const Pose &pose, double factor) {
    Pose closer = pose;
    closer.isFitted = false;
    closer.zoom *= factor;
    return closer;
}

} // namespace pellucid::ui
