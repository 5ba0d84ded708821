// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "gpu/context.h"

namespace pellucid::gpu {

/// A core context without a window or a display server, through EGL: of the first graphics card, or
/// of a software renderer if none is there and `software` ones will do. Asks for OpenGL 4.3, takes
/// 3.3 if that is all there is.
class SurfacelessContext final : public Context {
public:
    /// *Throws* Error{noSuchDevice} with the reason.
    explicit SurfacelessContext(bool software = true);
    ~SurfacelessContext() override;
    SurfacelessContext(const SurfacelessContext &) = delete;
    SurfacelessContext &operator=(const SurfacelessContext &) = delete;

    void makeCurrent() override;
    void doneCurrent() override;

private:
    void *m_display = nullptr;
    void *m_context = nullptr;
};

} // namespace pellucid::gpu
