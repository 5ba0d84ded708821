// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "gpu/context.h"

namespace pellucid::gpu {

/// An EGL core-profile context without a window or display server: of the first graphics card, or
/// of a software renderer if there is no card and `software` allows it. OpenGL 4.3, or 3.3 if no
/// device has 4.3.
class SurfacelessContext final : public Context {
public:
    /// `software`: accept a software renderer. *Throws* Error{noSuchDevice} with the reason.
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
