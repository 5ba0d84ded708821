// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace pellucid::gpu {

/// Version, renderer and limits of an OpenGL context.
struct Capabilities {
    int version = 0; ///< major * 10 + minor
    std::string renderer;
    bool software = false;                          ///< llvmpipe, softpipe, SwiftShader, WARP, GDI
    int largest3dTexture = 0, largest2dTexture = 0; ///< texels per side
    int textureUnits = 0;                           ///< per compute shader
    std::size_t sharedBytes = 0;                    ///< per work group
    std::size_t storageBytes = 0;                   ///< per storage buffer

    bool canShowImages() const { return version >= 33; }
    /// The engine needs compute shaders, storage buffers and immutable textures.
    bool canRender() const { return version >= 43; }
};

/// Call it after a context has become current on a thread, before other functions of OpenGL: on
/// Windows, a driver's functions belong to a context, and libepoxy must look them up again.
void contextHasChanged();

/// Those of the context that is current on the calling thread; without limits below OpenGL 3.3.
Capabilities currentCapabilities();

/// Memory that is free on the card now; empty unless a vendor's extension reports it.
std::optional<std::size_t> freeCardBytes();

} // namespace pellucid::gpu
