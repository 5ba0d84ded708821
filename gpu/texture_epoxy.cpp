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
    : m_id(std::exchange(other.m_id, 0)), m_width(other.m_width), m_height(other.m_height),
      m_channels(other.m_channels) {}

FloatTexture &FloatTexture::operator=(FloatTexture &&other) noexcept {
    std::swap(m_id, other.m_id);
    std::swap(m_width, other.m_width);
    std::swap(m_height, other.m_height);
    std::swap(m_channels, other.m_channels);
    return *this;
}

void FloatTexture::upload(int width, int height, int channels, const float *samples) {
    const GLenum format = channels == 1 ? GL_RED : GL_RGB;
    glBindTexture(GL_TEXTURE_2D, m_id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (width != m_width || height != m_height || channels != m_channels) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, channels == 1 ? GL_RED : GL_GREEN);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, channels == 1 ? GL_RED : GL_BLUE);
        glTexImage2D(GL_TEXTURE_2D, 0, channels == 1 ? GL_R32F : GL_RGB32F, width, height, 0,
                     format, GL_FLOAT, samples);
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, GL_FLOAT, samples);
    }
    m_width = width;
    m_height = height;
    m_channels = channels;
}

} // namespace pellucid::gpu
