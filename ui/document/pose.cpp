// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/pose.h"

#include <algorithm>
#include <cmath>

#include <glm/vector_relational.hpp>

namespace pellucid::ui {

double fittingPixelMm(double radiusMm, const QSizeF &paneSize) {
    const double side = std::max(1.0, std::min(paneSize.width(), paneSize.height()));
    // The outer seventh of the sphere around a scan contains only the corners of its box, which are
    // air.
    return 2.0 * radiusMm / side * 0.86;
}

Pose fitted(const Pose &pose, const glm::dvec3 &lowMm, const glm::dvec3 &highMm, double fitMm,
            const QSizeF &paneSize) {
    // Beside the body, there is room for names, letters, and the scale.
    constexpr double shareOfPane = 0.9;
    Pose fit = pose;
    fit.isFitted = true;
    if (!glm::all(glm::lessThan(lowMm, highMm)))
        return fit;
    const scene::ProjectedBox box = scene::projectBox(lowMm, highMm, pose.orientation);
    const double pixelMm = std::max(2.0 * box.halfMm.x / std::max(1.0, paneSize.width()),
                                    2.0 * box.halfMm.y / std::max(1.0, paneSize.height())) /
                           shareOfPane;
    fit.zoom = std::clamp(fitMm / pixelMm, minZoom, maxZoom);
    fit.panMm = box.middleMm;
    return fit;
}

scene::Camera cameraOf(const Pose &pose, double fitMm, const QSizeF &paneSize) {
    scene::Camera camera;
    camera.orientation = pose.orientation;
    camera.pixelMm = fitMm / pose.zoom;
    camera.width = std::max(2, int(std::lround(paneSize.width())));
    camera.height = std::max(2, int(std::lround(paneSize.height())));
    camera.panMm = pose.panMm;
    return camera;
}

} // namespace pellucid::ui
