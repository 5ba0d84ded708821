// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::gpu {

/// What the current context is.
struct Capabilities {
    int version = 0; ///< major * 10 + minor
    std::string renderer;
    bool software = false; ///< llvmpipe, softpipe, SwiftShader, WARP, GDI
    bool canShowImages() const { return version >= 33; }
};

Capabilities currentCapabilities();

} // namespace pellucid::gpu
