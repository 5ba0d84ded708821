// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/compose.h"
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
    void draw(const picture::ToneRange &range, bool inverted) const;
    /// Draws a picture that is already on the card.
    void draw(const CardPicture &picture, const picture::ToneRange &range, bool inverted) const;

private:
    void draw(unsigned texture, int layers, const CardPicture::Colors &colors,
              const picture::ToneRange &range, bool inverted) const;

    Program m_program;
    PixelTexture m_texture;
    VertexArrayName m_vertexArray;
    int m_range, m_inverted, m_layers, m_colors;
};

} // namespace pellucid::gpu
