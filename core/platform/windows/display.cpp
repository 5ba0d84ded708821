// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/display.h"

#include <cstdio>

#include "core/platform/windows/error.h"
// After windows.h.
#include <dwmapi.h>

namespace pellucid::platform {

bool mayHaveDisplay() {
    return true;
}

// A part of Windows.
bool windowsHaveOpenGl() {
    return true;
}

bool canLoad(const char *library) {
    return ::LoadLibraryA(library) != nullptr;
}

void setTitleBar(std::uintptr_t window, bool isDark) {
    constexpr DWORD useImmersiveDarkMode = 20; // of newer headers
    const BOOL value = isDark ? TRUE : FALSE;
    ::DwmSetWindowAttribute(reinterpret_cast<HWND>(window), useImmersiveDarkMode, &value,
                            sizeof value);
}

void reportAtStart(const std::string &line) {
    if (::GetStdHandle(STD_ERROR_HANDLE) != nullptr)
        std::fprintf(stderr, "%s\n", line.c_str());
    else
        ::MessageBoxW(nullptr, std::filesystem::path(line).c_str(), L"Pellucid",
                      MB_OK | MB_ICONERROR);
}

} // namespace pellucid::platform
