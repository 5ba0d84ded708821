// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_camera.h"

#include <algorithm>
#include <cmath>

#include <QWidget>

#include "ui/document/document.h"
#include "ui/views/camera_moves.h"

namespace pellucid::ui {

namespace {

constexpr double smallestZoom = 0.2, largestZoom = 20.0;

} // namespace

double ProjectionCamera::fittingPixelMm() const {
    const double ratio = m_pane.devicePixelRatioF();
    const double side = std::max(1.0, std::min(m_pane.width(), m_pane.height()) * ratio);
    // The outer seventh of the sphere around a scan holds only the corners of its box, which are
    // air.
    return m_document.volume() ? 2.0 * m_document.volume()->lattice().radiusMm() / side * 0.86
                               : 1.0;
}

void ProjectionCamera::fit() {
    scene::Camera camera = m_document.scene().camera;
    const double ratio = m_pane.devicePixelRatioF();
    camera.width = std::max(2, int(std::lround(m_pane.width() * ratio)));
    camera.height = std::max(2, int(std::lround(m_pane.height() * ratio)));
    camera.pixelMm = fittingPixelMm() / m_zoom;
    m_document.setCamera(camera);
}

void ProjectionCamera::fitWhole() {
    m_zoom = 1.0;
    fit();
}

void ProjectionCamera::reset() {
    scene::Camera camera = m_document.scene().camera;
    camera.orientation = scene::viewOrientation(scene::StandardView::front);
    camera.panMm = {0.0, 0.0};
    m_document.setCamera(camera);
    fitWhole();
}

void ProjectionCamera::zoomBy(double factor) {
    m_zoom = std::clamp(m_zoom * factor, smallestZoom, largestZoom);
    fit();
}

void ProjectionCamera::adopt(const scene::Camera &wanted,
                             const std::optional<glm::dvec3> &pivotMm) {
    scene::Camera camera = m_document.scene().camera;
    camera.orientation = wanted.orientation;
    camera.panMm = pannedTo(wanted, pivotMm.value_or(this->pivotMm()), this->pivotMm());
    m_document.setCamera(camera);
    m_zoom = std::clamp(fittingPixelMm() / wanted.pixelMm, smallestZoom, largestZoom);
    fit();
}

glm::dvec3 ProjectionCamera::pivotMm() const {
    return m_orbitsCrosshair && m_document.volume()
               ? m_document.crosshair().mm - m_document.volume()->lattice().center().mm
               : glm::dvec3(0.0);
}

PaneMapping ProjectionCamera::mapping(const scene::Camera &camera) const {
    PaneMapping mapping;
    mapping.pixelRatio = m_pane.devicePixelRatioF();
    const glm::dmat3 axes = camera.axes();
    mapping.plane = {{}, {axes[0], axes[1]}, camera.pixelMm, camera.width, camera.height};
    if (m_document.volume())
        mapping.plane.center = {m_document.volume()->lattice().center().mm +
                                camera.panMm.x * axes[0] + camera.panMm.y * axes[1]};
    return mapping;
}

} // namespace pellucid::ui
