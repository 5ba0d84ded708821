// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/surfaceless_context.h"

#include <array>

#include <epoxy/egl.h>

namespace pellucid::test {

SurfacelessContext::SurfacelessContext() {
    // The core name of this call aborts in libepoxy without a display; the extension's does not.
    m_display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    int major = 0, minor = 0;
    if (m_display == EGL_NO_DISPLAY || eglInitialize(m_display, &major, &minor) == EGL_FALSE ||
        eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        m_reason = "no EGL display";
        return;
    }
    const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    m_context = eglCreateContext(m_display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (m_context == EGL_NO_CONTEXT ||
        eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context) == EGL_FALSE) {
        m_reason = "no OpenGL 3.3 context";
        m_context = nullptr;
    }
}

SurfacelessContext::~SurfacelessContext() {
    if (m_context == nullptr)
        return;
    eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(m_display, m_context);
    eglTerminate(m_display);
}

} // namespace pellucid::test
