// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/tone_pass.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

TonePass::TonePass()
    : m_program("tone.vert", "tone.frag"), m_range(m_program.uniform("range")),
      m_inverted(m_program.uniform("inverted")) {
    // Core profiles draw nothing without a vertex array, even where no attribute is read.
    glGenVertexArrays(1, &m_vertexArray);
}

TonePass::~TonePass() {
    glDeleteVertexArrays(1, &m_vertexArray);
}

void TonePass::upload(const render::ProjectionImage &image) {
    m_texture.upload(image.width, image.height, image.channels, image.samples.data());
}

void TonePass::draw(const render::ToneRange &range, bool inverted) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glUseProgram(m_program.id());
    glUniform2f(m_range, float(range.low), float(range.high));
    glUniform1i(m_inverted, inverted ? 1 : 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, m_texture.id());
    glBindVertexArray(m_vertexArray);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
}

} // namespace pellucid::gpu
