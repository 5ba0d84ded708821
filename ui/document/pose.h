// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSizeF>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

#include "core/scene/camera.h"

namespace pellucid::ui {

/// How the projection is looked at, whatever the size of its pane. By default the volume is seen
/// from the front, centered, and fits the pane.
struct Pose {
    /// As that of `scene::Camera`.
    glm::dquat orientation = scene::viewOrientation(scene::StandardView::front);
    glm::dvec2 panMm{0.0};
    /// 1: the volume fits the pane; above 1: the picture is larger.
    double zoom = 1.0;
    /// Resizing and standard views fit the body again; false after panning or zooming by hand.
    bool isFitted = true;

    bool operator==(const Pose &) const = default;
};

inline constexpr double minZoom = 0.2, maxZoom = 20.0;

/// The pixel size at which a volume of this radius fits a pane. *Units*: `paneSize`: device pixels,
/// not rounded.
double fittingPixelMm(double radiusMm, const QSizeF &paneSize);

/// The pose that fits the shadow of a box, seen from `pose`, into a pane; the same pose if the box
/// is empty. *Units*: `lowMm`, `highMm`: LPS, from the middle of the volume; `fitMm`, `paneSize`:
/// as `cameraOf`.
Pose fitted(const Pose &pose, const glm::dvec3 &lowMm, const glm::dvec3 &highMm, double fitMm,
            const QSizeF &paneSize);
/// The camera of a pose in a pane of this size. *Units*: as `fittingPixelMm`, whose result is
/// `fitMm`.
scene::Camera cameraOf(const Pose &pose, double fitMm, const QSizeF &paneSize);

} // namespace pellucid::ui
