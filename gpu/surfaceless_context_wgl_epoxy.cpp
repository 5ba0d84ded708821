// SPDX-License-Identifier: GPL-3.0-or-later
// Windows makes contexts for windows alone, so this one has a window that is never shown.
#include "gpu/surfaceless_context.h"

#include <vector>

#include <epoxy/wgl.h>
// libepoxy finds these by what it knows of the thread's context, which they change.
#undef wglCreateContext
#undef wglDeleteContext
#undef wglMakeCurrent

#include "core/task/error.h"
#include "gpu/capabilities.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

namespace {

namespace because = task::because;

[[noreturn]] void refuse(const task::Reason &why) {
    throw task::Error(task::ErrorCode::noSuchDevice, why);
}

// The device context of a hidden window whose pixels OpenGL can draw.
HDC newDeviceContext() {
    const HWND window = ::CreateWindowExW(0, L"STATIC", L"", WS_POPUP, 0, 0, 1, 1, nullptr, nullptr,
                                          nullptr, nullptr);
    const HDC device = window != nullptr ? ::GetDC(window) : nullptr;
    PIXELFORMATDESCRIPTOR format{};
    format.nSize = sizeof format;
    format.nVersion = 1;
    format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL;
    format.iPixelType = PFD_TYPE_RGBA;
    format.cColorBits = 24;
    const int number = device != nullptr ? ::ChoosePixelFormat(device, &format) : 0;
    if (number == 0 || ::SetPixelFormat(device, number, &format) == FALSE) {
        ::DestroyWindow(window);
        return nullptr;
    }
    return device;
}

void destroy(HDC device) {
    ::DestroyWindow(::WindowFromDC(device));
}

// A context that reports driver resets if possible, else one that does not.
HGLRC contextOf(HDC device, int major, int minor) {
    for (const bool isRobust : {true, false}) {
        std::vector<int> attributes{
            WGL_CONTEXT_MAJOR_VERSION_ARB, major,
            WGL_CONTEXT_MINOR_VERSION_ARB, minor,
            WGL_CONTEXT_PROFILE_MASK_ARB,  WGL_CONTEXT_CORE_PROFILE_BIT_ARB};
        if (isRobust)
            attributes.insert(attributes.end(),
                              {WGL_CONTEXT_FLAGS_ARB, WGL_CONTEXT_ROBUST_ACCESS_BIT_ARB,
                               WGL_CONTEXT_RESET_NOTIFICATION_STRATEGY_ARB,
                               WGL_LOSE_CONTEXT_ON_RESET_ARB});
        attributes.push_back(0);
        if (const HGLRC context = wglCreateContextAttribsARB(device, nullptr, attributes.data()))
            return context;
    }
    return nullptr;
}

} // namespace

void contextHasChanged() {
    epoxy_handle_external_wglMakeCurrent();
}

SurfacelessContext::SurfacelessContext(bool software) {
    const HDC device = newDeviceContext();
    if (device == nullptr)
        refuse(because::noContext);
    // Only an old context tells how to make a new one.
    const HGLRC first = wglCreateContext(device);
    bool isCard = false, makesNew = false;
    if (first != nullptr && wglMakeCurrent(device, first) != FALSE) {
        contextHasChanged();
        isCard = !currentCapabilities().software;
        makesNew = epoxy_has_wgl_extension(device, "WGL_ARB_create_context_profile");
    }
    if (makesNew && (isCard || software))
        for (const auto &[major, minor] : {std::pair(4, 3), {3, 3}})
            if (m_context == nullptr)
                m_context = contextOf(device, major, minor);
    wglMakeCurrent(nullptr, nullptr);
    wglDeleteContext(first);
    if (m_context == nullptr) {
        destroy(device);
        refuse(!isCard && !software ? because::noCard : because::noContext);
    }
    m_display = device;
}

SurfacelessContext::~SurfacelessContext() {
    wglDeleteContext(static_cast<HGLRC>(m_context));
    destroy(static_cast<HDC>(m_display));
}

void SurfacelessContext::makeCurrent() {
    if (wglMakeCurrent(static_cast<HDC>(m_display), static_cast<HGLRC>(m_context)) == FALSE)
        refuse(because::contextUnusable);
    contextHasChanged();
}

void SurfacelessContext::doneCurrent() {
    wglMakeCurrent(nullptr, nullptr);
}

} // namespace pellucid::gpu
