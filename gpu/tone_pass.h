// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/render/compose.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace pellucid::gpu {

/// Draws a projection into the current framebuffer's viewport: render::compose on the card. Belongs
/// to the context that is current when it is made.
class TonePass {
public:
    /// *Throws* Error{internal} if the shaders do not compile.
    TonePass();
    ~TonePass();
    TonePass(const TonePass &) = delete;
    TonePass &operator=(const TonePass &) = delete;

    void upload(const render::ProjectionImage &image);
    /// Stretches the last image over the viewport.
    void draw(const render::ToneRange &range, bool inverted) const;

private:
    Program m_program;
    FloatTexture m_texture;
    unsigned m_vertexArray = 0;
    int m_range, m_inverted;
};

} // namespace pellucid::gpu
