// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QWidget>

#include "core/picture/compose.h"
#include "gpu/frame_passes.h"

namespace pellucid::ui {

/// The surface that shows a projection, scaled to its area.
class ProjectionCanvas {
public:
    virtual ~ProjectionCanvas() = default;
    virtual QWidget *widget() = 0;
    using Image = std::shared_ptr<const picture::ProjectionImage>;
    /// Null shows black.
    virtual void setImage(Image image) = 0;
    /// Shows a picture that is on the graphics card; a canvas that cannot draw it there downloads
    /// it.
    virtual void setPicture(std::shared_ptr<const gpu::CardPicture> picture) = 0;
    virtual void setDisplay(const picture::Display &display) = 0;
};

/// A canvas on OpenGL 3.3 or newer with the GLSL tone pass; on the processor if there is no OpenGL,
/// or only a software renderer.
std::unique_ptr<ProjectionCanvas> makeProjectionCanvas(QWidget *parent);
/// The canvas on OpenGL, whatever draws it.
std::unique_ptr<ProjectionCanvas> makeOpenGlCanvas(QWidget *parent);

} // namespace pellucid::ui
