// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/handle.h"

#include <epoxy/gl.h>

#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

void deleteBuffer(unsigned name) {
    glDeleteBuffers(1, &name);
}

void deleteTexture(unsigned name) {
    glDeleteTextures(1, &name);
}

void deleteProgram(unsigned name) {
    glDeleteProgram(name);
}

void deleteShader(unsigned name) {
    glDeleteShader(name);
}

void deleteVertexArray(unsigned name) {
    glDeleteVertexArrays(1, &name);
}

void deleteQuery(unsigned name) {
    glDeleteQueries(1, &name);
}

BufferName makeBuffer() {
    unsigned name = 0;
    glGenBuffers(1, &name);
    return BufferName(name);
}

TextureName makeTexture() {
    unsigned name = 0;
    glGenTextures(1, &name);
    return TextureName(name);
}

VertexArrayName makeVertexArray() {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    return VertexArrayName(name);
}

QueryName makeQuery() {
    unsigned name = 0;
    glGenQueries(1, &name);
    return QueryName(name);
}

void checkErrors(const char *doing) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR)
        return;
    // A lost context may report errors forever.
    for (int n = 0; n < 16 && glGetError() != GL_NO_ERROR; ++n)
        ;
    if (first == GL_CONTEXT_LOST)
        throw task::Error(task::ErrorCode::noSuchDevice, task::because::cardWasLost);
    if (first == GL_OUT_OF_MEMORY)
        throw task::Error(task::ErrorCode::outOfMemory, task::because::cardLacksMemory(doing));
    throw task::Error(task::ErrorCode::internal, task::because::openGlError(first, doing));
}

} // namespace pellucid::gpu
