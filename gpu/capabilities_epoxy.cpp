// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/capabilities.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

Capabilities currentCapabilities() {
    Capabilities c;
    c.version = epoxy_gl_version();
    if (const auto *name = reinterpret_cast<const char *>(glGetString(GL_RENDERER)))
        c.renderer = name;
    for (const char *software :
         {"llvmpipe", "softpipe", "SwiftShader", "WARP", "GDI Generic", "Microsoft Basic Render"})
        c.software = c.software || c.renderer.find(software) != std::string::npos;
    return c;
}

} // namespace pellucid::gpu
