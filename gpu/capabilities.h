// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace pellucid::gpu {

/// What the current context is.
struct Capabilities {
    int version = 0; ///< major * 10 + minor
    std::string renderer;
    bool software = false;                          ///< llvmpipe, softpipe, SwiftShader, WARP, GDI
    int largest3dTexture = 0, largest2dTexture = 0; ///< texels a side
    int textureUnits = 0;                           ///< of a compute shader
    std::size_t sharedBytes = 0;                    ///< of a work group
    std::size_t storageBytes = 0;                   ///< of one storage buffer

    bool canShowImages() const { return version >= 33; }
    /// Compute shaders, storage buffers and immutable textures, which the engine is made of.
    bool canRender() const { return version >= 43; }
};

Capabilities currentCapabilities();

/// What the card has free now, where a vendor's extension tells.
std::optional<std::size_t> freeCardBytes();

} // namespace pellucid::gpu
