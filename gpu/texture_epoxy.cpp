// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/texture.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

namespace {

void resetUnpacking() {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
}

} // namespace

PixelTexture::PixelTexture() : m_name(makeTexture()) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, m_name.name());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
}

void PixelTexture::allocate(int width, int height, int layers, int channels, const float *samples) {
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_SWIZZLE_G, channels == 1 ? GL_RED : GL_GREEN);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_SWIZZLE_B, channels == 1 ? GL_RED : GL_BLUE);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, channels == 1 ? GL_R32F : GL_RGB32F, width, height, layers,
                 0, channels == 1 ? GL_RED : GL_RGB, GL_FLOAT, samples);
    m_width = width;
    m_height = height;
    m_layers = layers;
    m_channels = channels;
}

void PixelTexture::upload(int width, int height, int channels, const float *samples) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, m_name.name());
    resetUnpacking();
    if (width != m_width || height != m_height || m_layers != 1 || channels != m_channels)
        allocate(width, height, 1, channels, samples);
    else
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, width, height, 1,
                        channels == 1 ? GL_RED : GL_RGB, GL_FLOAT, samples);
}

void PixelTexture::reserve(int width, int height, int layers) {
    if (width == m_width && height == m_height && layers == m_layers && m_channels == 1)
        return;
    glBindTexture(GL_TEXTURE_2D_ARRAY, m_name.name());
    resetUnpacking();
    allocate(width, height, layers, 1, nullptr);
    m_width = 0; // if memory runs out, the texture must not look ready
    checkErrors("a picture");
    m_width = width;
}

picture::Samples PixelTexture::download() const {
    picture::Samples samples(std::size_t(m_width) * std::size_t(m_height) * std::size_t(m_layers));
    glBindTexture(GL_TEXTURE_2D_ARRAY, m_name.name());
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RED, GL_FLOAT, samples.data());
    checkErrors("reading a picture back");
    return samples;
}

void PixelTexture::clear() {
    const std::vector<float> zero(std::size_t(m_width) * std::size_t(m_height) *
                                  std::size_t(m_layers));
    glBindTexture(GL_TEXTURE_2D_ARRAY, m_name.name());
    resetUnpacking();
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, m_width, m_height, m_layers, GL_RED, GL_FLOAT,
                    zero.data());
}

ComplexTexture::ComplexTexture(const std::array<int, 3> &size, fourier::Storage storage)
    : m_name(makeTexture()), m_size(size), m_storage(storage) {
    glBindTexture(GL_TEXTURE_3D, m_name.name());
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
    glTexStorage3D(GL_TEXTURE_3D, 1, storage == fourier::Storage::float32 ? GL_RG32F : GL_RG16F,
                   size[0], size[1], size[2]);
    checkErrors("the spectrum");
}

void ComplexTexture::upload(int firstPlane, int planes, const void *cells) {
    glBindTexture(GL_TEXTURE_3D, m_name.name());
    resetUnpacking();
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, firstPlane, m_size[0], m_size[1], planes, GL_RG,
                    m_storage == fourier::Storage::float32 ? GL_FLOAT : GL_HALF_FLOAT, cells);
    checkErrors("the spectrum");
}

} // namespace pellucid::gpu
