// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/capabilities.h"

#include <array>

#include <epoxy/gl.h>

namespace pellucid::gpu {

namespace {

std::size_t limit(GLenum name) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value > 0 ? std::size_t(value) : 0;
}

} // namespace

Capabilities currentCapabilities() {
    Capabilities c;
    c.version = epoxy_gl_version();
    if (const auto *name = reinterpret_cast<const char *>(glGetString(GL_RENDERER)))
        c.renderer = name;
    for (const char *software :
         {"llvmpipe", "softpipe", "SwiftShader", "WARP", "GDI Generic", "Microsoft Basic Render"})
        c.software = c.software || c.renderer.find(software) != std::string::npos;
    if (!c.canShowImages()) // Windows without a driver has 1.1, without glGetInteger64v
        return c;
    c.largest3dTexture = int(limit(GL_MAX_3D_TEXTURE_SIZE));
    c.largest2dTexture = int(limit(GL_MAX_TEXTURE_SIZE));
    if (c.version >= 43) {
        c.textureUnits = int(limit(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS));
        c.sharedBytes = limit(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
        c.storageBytes = limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    }
    return c;
}

std::optional<std::size_t> freeCardBytes() {
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        return limit(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX) * 1024;
    if (epoxy_has_gl_extension("GL_ATI_meminfo")) {
        std::array<GLint, 4> kilobytes{};
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kilobytes.data());
        return std::size_t(kilobytes[0]) * 1024;
    }
    return std::nullopt;
}

} // namespace pellucid::gpu
