// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/buffer.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

void Buffer::fit(std::size_t bytes) {
    if (bytes <= m_bytes)
        return;
    glBindBuffer(GL_COPY_WRITE_BUFFER, m_name.name());
    glBufferData(GL_COPY_WRITE_BUFFER, GLsizeiptr(bytes), nullptr, GL_DYNAMIC_COPY);
    m_bytes = 0;
    checkErrors("a buffer");
    m_bytes = bytes;
}

void Buffer::upload(const void *data, std::size_t bytes) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, m_name.name());
    // New storage each time: the card may still read the old one.
    glBufferData(GL_COPY_WRITE_BUFFER, GLsizeiptr(bytes), data, GL_STREAM_DRAW);
    checkErrors("a buffer");
    m_bytes = bytes;
}

void Buffer::bindStorage(int binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(binding), m_name.name());
}

void Buffer::bindUniform(int binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, GLuint(binding), m_name.name());
}

} // namespace pellucid::gpu
