// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/surfaceless_context.h"

#include <array>
#include <string_view>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "core/platform/display.h"
#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

namespace {

namespace because = task::because;

[[noreturn]] void refuse(const task::Reason &why) {
    throw task::Error(task::ErrorCode::noSuchDevice, why);
}

bool has(const char *extensions, std::string_view name) {
    return extensions != nullptr && std::string_view(extensions).find(name) != std::string::npos;
}

// libepoxy aborts the program if a library that it loads is missing. The library stays loaded.
using platform::canLoad;

struct Candidate {
    EGLDisplay display;
    bool software;
};

// Graphics cards first. A display is shared by the whole process and never terminated: another
// context may use it.
std::vector<Candidate> candidates() {
    std::vector<Candidate> found;
    const char *const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has(client, "EGL_EXT_platform_device") && has(client, "EGL_EXT_device_enumeration") &&
        has(client, "EGL_EXT_device_query")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count);
        for (const bool software : {false, true})
            for (EGLint n = 0; n < count; ++n) {
                EGLDeviceEXT device = devices[std::size_t(n)];
                const bool isSoftware = has(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS),
                                            "EGL_MESA_device_software");
                if (isSoftware == software)
                    found.push_back(
                        {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                         software});
            }
    }
    // Without a display, libepoxy aborts in the core function but not in the extension's.
    if (has(client, "EGL_MESA_platform_surfaceless"))
        found.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             true});
    return found;
}

// No config if the display allows that, then any config that supports pbuffers.
std::vector<EGLConfig> configs(EGLDisplay display) {
    std::vector<EGLConfig> found;
    if (has(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context"))
        found.push_back(EGL_NO_CONFIG_KHR);
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_TRUE && count > 0)
        found.push_back(config);
    return found;
}

// A context that reports driver resets if possible, else one that does not.
EGLContext contextOf(EGLDisplay display, int major, int minor) {
    for (const EGLConfig config : configs(display))
        for (const bool isRobust : {true, false}) {
            std::vector<EGLint> attributes{
                EGL_CONTEXT_MAJOR_VERSION,       major,
                EGL_CONTEXT_MINOR_VERSION,       minor,
                EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
            if (isRobust)
                attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                                     EGL_LOSE_CONTEXT_ON_RESET});
            attributes.push_back(EGL_NONE);
            const EGLContext context =
                eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
            if (context != EGL_NO_CONTEXT)
                return context;
        }
    return EGL_NO_CONTEXT;
}

} // namespace

void contextHasChanged() {}

SurfacelessContext::SurfacelessContext(bool software) {
    if (!canLoad("libEGL.so.1"))
        refuse(because::noLibEgl);
    if (!canLoad("libOpenGL.so.0") && !canLoad("libGL.so.1"))
        refuse(because::noLibOpenGl);
    bool wasFound = false;
    // A later device with OpenGL 4.3 is better than an earlier one without.
    for (const auto &[major, minor] : {std::pair(4, 3), {3, 3}})
        for (const Candidate &candidate : candidates()) {
            if (candidate.display == EGL_NO_DISPLAY || (candidate.software && !software) ||
                eglInitialize(candidate.display, nullptr, nullptr) == EGL_FALSE ||
                eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
                continue;
            wasFound = true;
            m_display = candidate.display;
            m_context = contextOf(m_display, major, minor);
            if (m_context != EGL_NO_CONTEXT)
                return;
        }
    refuse(wasFound ? because::noContext : software ? because::noEglDevice : because::noCard);
}

SurfacelessContext::~SurfacelessContext() {
    eglDestroyContext(m_display, m_context);
}

void SurfacelessContext::makeCurrent() {
    // EGL's current API is a setting of the thread.
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context) == EGL_FALSE)
        refuse(because::contextUnusable);
}

void SurfacelessContext::doneCurrent() {
    eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

} // namespace pellucid::gpu
