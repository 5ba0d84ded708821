// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/tone_pass.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

TonePass::TonePass()
    : m_program("tone.vert", "tone.frag"), m_vertexArray(makeVertexArray()),
      m_range(m_program.uniform("range")), m_inverted(m_program.uniform("inverted")),
      m_layers(m_program.uniform("layers")), m_colors(m_program.uniform("colors")) {}

void TonePass::upload(const picture::ProjectionImage &image) {
    m_texture.upload(image.width, image.height, image.channels, image.samples.data());
}

void TonePass::draw(const picture::ToneRange &range, bool inverted) const {
    draw(m_texture.id(), 1, {{{1.0F, 1.0F, 1.0F}}}, range, inverted);
}

void TonePass::draw(const CardPicture &picture, const picture::ToneRange &range,
                    bool inverted) const {
    draw(picture.texture(), picture.layers(), picture.colors(), range, inverted);
    picture.markDrawn();
}

void TonePass::draw(unsigned texture, int layers, const CardPicture::Colors &colors,
                    const picture::ToneRange &range, bool inverted) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glUseProgram(m_program.id());
    glUniform2f(m_range, float(range.low), float(range.high));
    glUniform1i(m_inverted, inverted ? 1 : 0);
    glUniform1i(m_layers, layers);
    glUniform3fv(m_colors, int(colors.size()), colors.front().data());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
    // Core profiles draw nothing without a vertex array, even if the shader reads no attribute.
    glBindVertexArray(m_vertexArray.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
}

} // namespace pellucid::gpu
