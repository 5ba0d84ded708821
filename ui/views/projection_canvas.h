// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QWidget>

#include "core/picture/compose.h"
#include "gpu/frame_passes.h"

namespace pellucid::ui {

/// The surface that shows a projection stretched over its area.
class ProjectionCanvas {
public:
    virtual ~ProjectionCanvas() = default;
    virtual QWidget *widget() = 0;
    /// An empty image shows black.
    virtual void setImage(const picture::ProjectionImage &image) = 0;
    /// The same of a picture on the graphics card, for a canvas that can draw it.
    virtual void setPicture(std::shared_ptr<const gpu::CardPicture> picture) = 0;
    virtual void setTone(const picture::ToneRange &range, bool inverted) = 0;
};

/// A canvas on OpenGL 3.3 or newer with the GLSL tone pass, or, where there is none, on the
/// processor.
std::unique_ptr<ProjectionCanvas> makeProjectionCanvas(QWidget *parent);

} // namespace pellucid::ui
