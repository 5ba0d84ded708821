// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/tone_pass.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

TonePass::TonePass() : m_program("tone.vert", "tone.frag"), m_vertexArray(makeVertexArray()) {}

void TonePass::upload(const picture::ProjectionImage &image) {
    m_texture.upload(image.width, image.height, image.channels, image.samples.data());
    m_pixelMm = image.pixelMm;
}

void TonePass::draw(const picture::Display &display) {
    PictureTexture picture;
    picture.texture = m_texture.id();
    picture.width = m_texture.width();
    picture.height = m_texture.height();
    picture.pixelMm = m_pixelMm;
    draw(picture, display);
}

void TonePass::draw(const CardPicture &picture, const picture::Display &display) {
    draw({picture.texture(), picture.width(), picture.height(), picture.layers(), picture.pixelMm(),
          picture.colors()},
         display);
    picture.markDrawn();
}

void TonePass::draw(const PictureTexture &picture, const picture::Display &display) {
    const GridTexture *const correction =
        display.contrast.isOff() ? nullptr : &m_contrast.correction(picture, display);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glUseProgram(m_program.id());
    const auto at = [&](const char *name) { return m_program.uniform(name); };
    glUniform2f(at("range"), float(display.range.low), float(display.range.high));
    glUniform1f(at("exponent"), float(display.exponent));
    glUniform2f(at("air"), float(display.air), float(display.airFade));
    glUniform1i(at("inverted"), display.inverted ? 1 : 0);
    glUniform1i(at("layers"), picture.layers);
    glUniform3fv(at("colors"), int(picture.colors.size()), picture.colors.front().data());
    glUniform1i(at("projection"), 0);
    glUniform1i(at("correction"), 1);
    glUniform1i(at("isCorrected"), correction == nullptr ? 0 : 1);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, correction == nullptr ? 0 : correction->id());
    if (correction != nullptr)
        glUniform2f(at("correctionScale"),
                    float(picture.width) / float(m_contrast.factor() * correction->width()),
                    float(picture.height) / float(m_contrast.factor() * correction->height()));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, picture.texture);
    // Core profiles draw nothing without a vertex array, even if the shader reads no attribute.
    glBindVertexArray(m_vertexArray.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
}

} // namespace pellucid::gpu
