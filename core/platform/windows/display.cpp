// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/display.h"

#include "core/platform/windows/error.h"

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

} // namespace pellucid::platform
