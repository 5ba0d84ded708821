// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::platform {

/// False if the environment names no display and no other way to show windows.
bool mayHaveDisplay();
/// Whether the library is there that windows draw with OpenGL by.
bool windowsHaveOpenGl();
/// Whether a library can be loaded; it then stays loaded.
bool canLoad(const char *library);

} // namespace pellucid::platform
