// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace pellucid::platform {

/// False if the environment names no display and no other way to show windows.
bool mayHaveDisplay();
/// Whether the OpenGL library that Qt's windows need is installed.
bool windowsHaveOpenGl();
/// Whether a library can be loaded; it then stays loaded.
bool canLoad(const char *library);
/// Makes a window's title bar dark or light, on systems where the program decides.
void setTitleBar(std::uintptr_t window, bool isDark);

/// Reports why the program ends before its window appears: on standard error or, if nobody can read
/// that, in a message box.
void reportAtStart(const std::string &line);

} // namespace pellucid::platform
