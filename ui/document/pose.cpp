// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/pose.h"

#include <algorithm>
#include <cmath>

namespace pellucid::ui {

double fittingPixelMm(double radiusMm, const QSizeF &paneSize) {
    const double side = std::max(1.0, std::min(paneSize.width(), paneSize.height()));
    // The outer seventh of the sphere around a scan contains only the corners of its box, which are
    // air.
    return 2.0 * radiusMm / side * 0.86;
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
