// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/display.h"
#include "gpu/contrast_passes.h"
#include "gpu/frame_passes.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// Draws a projection into the viewport of the current framebuffer: picture::compose on the card.
/// Belongs to the context that is current when it is created.
class TonePass {
public:
    /// *Throws* Error{internal} if the shaders do not compile.
    TonePass();

    void upload(const picture::ProjectionImage &image);
    /// Draws the last uploaded image over the whole viewport.
    void draw(const picture::Display &display);
    /// Draws a picture that is already on the card.
    void draw(const CardPicture &picture, const picture::Display &display);
    /// Frees the memory of contrast; the next picture allocates it again.
    void releaseContrast() { m_contrast.release(); }

private:
    void draw(const PictureTexture &picture, const picture::Display &display);

    Program m_program;
    ContrastPasses m_contrast;
    PixelTexture m_texture;
    double m_pixelMm = 1.0; ///< of the uploaded image
    VertexArrayName m_vertexArray;
};

} // namespace pellucid::gpu
