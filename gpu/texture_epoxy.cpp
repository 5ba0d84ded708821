// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/texture.h"

#include <utility>

#include <epoxy/gl.h>

namespace pellucid::gpu {

FloatTexture::FloatTexture() {
    glGenTextures(1, &m_id);
    glBindTexture(GL_TEXTURE_2D, m_id);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

FloatTexture::~FloatTexture() {
    if (m_id != 0)
        glDeleteTextures(1, &m_id);
}

FloatTexture::FloatTexture(FloatTexture &&other) noexcept
    : m_id(std::exchange(other.m_id, 0)), m_width(other.m_width), m_height(other.m_height) {}

FloatTexture &FloatTexture::operator=(FloatTexture &&other) noexcept {
    std::swap(m_id, other.m_id);
    std::swap(m_width, other.m_width);
    std::swap(m_height, other.m_height);
    return *this;
}

void FloatTexture::upload(int width, int height, const float *samples) {
    glBindTexture(GL_TEXTURE_2D, m_id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (width != m_width || height != m_height)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, samples);
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_FLOAT, samples);
    m_width = width;
    m_height = height;
}

} // namespace pellucid::gpu
