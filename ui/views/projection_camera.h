// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "ui/views/pane_mapping.h"

class QWidget;

namespace pellucid::ui {

class Document;

/// The document's camera as a pane sets it: it fits the volume into the pane, times a zoom, and
/// turns about a pivot.
class ProjectionCamera {
public:
    ProjectionCamera(Document &document, const QWidget &pane)
        : m_document(document), m_pane(pane) {}

    /// Gives the camera the pane's pixels, and the size of one that the zoom asks for.
    void fit();
    /// The same at a zoom of 1, where the volume fills the pane.
    void fitWhole();
    /// From the front, whole and in the middle.
    void reset();
    /// Above 1: the picture becomes larger.
    void zoomBy(double factor);
    /// Looks the way another camera does, as far as the pane allows; `pivotMm`: of that camera's
    /// volume, this one's own if there is none.
    void adopt(const scene::Camera &wanted, const std::optional<glm::dvec3> &pivotMm);

    /// Turning keeps the crosshair, or the middle of the volume, where it is in the picture.
    void setOrbitsCrosshair(bool isAboutCrosshair) { m_orbitsCrosshair = isAboutCrosshair; }
    bool orbitsCrosshair() const { return m_orbitsCrosshair; }
    /// What turning leaves where it is in the picture. *Units*: mm, LPS, from the middle of the
    /// volume.
    glm::dvec3 pivotMm() const;
    /// Between places on a pane of the camera's size and in the patient.
    PaneMapping mapping(const scene::Camera &camera) const;

private:
    double fittingPixelMm() const;

    Document &m_document;
    const QWidget &m_pane;
    double m_zoom = 1.0;
    bool m_orbitsCrosshair = false;
};

} // namespace pellucid::ui
