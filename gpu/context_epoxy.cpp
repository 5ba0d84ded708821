// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/context.h"

#include <epoxy/gl.h>

namespace pellucid::gpu {

bool Context::isLost() {
    if (!m_detectsResets)
        m_detectsResets = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
    return *m_detectsResets && glGetGraphicsResetStatus() != GL_NO_ERROR;
}

} // namespace pellucid::gpu
