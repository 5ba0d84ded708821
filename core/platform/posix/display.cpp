// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/display.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <initializer_list>

namespace pellucid::platform {

bool mayHaveDisplay() {
    const auto names = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"};
    return std::any_of(names.begin(), names.end(), [](const char *name) {
        const char *const value = std::getenv(name);
        return value != nullptr && *value != '\0';
    });
}

bool windowsHaveOpenGl() {
    return canLoad("libGL.so.1");
}

bool canLoad(const char *library) {
    return ::dlopen(library, RTLD_LAZY) != nullptr;
}

// From the desktop's own theme.
void setTitleBar(std::uintptr_t, bool) {}

void reportAtStart(const std::string &line) {
    std::fprintf(stderr, "%s\n", line.c_str());
}

} // namespace pellucid::platform
