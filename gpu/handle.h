// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

namespace pellucid::gpu {

/// Owns the name of an OpenGL object and deletes it; 0: none. Belongs to the context that is
/// current when it is created, and to contexts that share with it; one of them must be current on
/// destruction. Move-only.
template <void (*deleteName)(unsigned)> class Handle {
public:
    Handle() = default;
    explicit Handle(unsigned name) : m_name(name) {}
    ~Handle() {
        if (m_name != 0)
            deleteName(m_name);
    }
    Handle(Handle &&other) noexcept : m_name(std::exchange(other.m_name, 0)) {}
    Handle &operator=(Handle &&other) noexcept {
        std::swap(m_name, other.m_name);
        return *this;
    }
    unsigned name() const { return m_name; }

private:
    unsigned m_name = 0;
};

void deleteBuffer(unsigned name);
void deleteTexture(unsigned name);
void deleteProgram(unsigned name);
void deleteShader(unsigned name);
void deleteVertexArray(unsigned name);
void deleteQuery(unsigned name);

using BufferName = Handle<deleteBuffer>;
using TextureName = Handle<deleteTexture>;
using ProgramName = Handle<deleteProgram>;
using ShaderName = Handle<deleteShader>;
using VertexArrayName = Handle<deleteVertexArray>;
using QueryName = Handle<deleteQuery>;

BufferName makeBuffer();
TextureName makeTexture();
VertexArrayName makeVertexArray();
QueryName makeQuery();

/// *Throws* Error{outOfMemory}, Error{noSuchDevice} or Error{internal} with `doing` if OpenGL
/// reports an error since the last call.
void checkErrors(const char *doing);

} // namespace pellucid::gpu
