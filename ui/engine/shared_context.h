// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "gpu/context.h"

class QOffscreenSurface;
class QOpenGLContext;

namespace pellucid::ui {

/// A context for the engine's own thread, which shares textures with the contexts of the windows.
/// It is made on the thread of the user interface.
class SharedContext final : public gpu::Context {
public:
    /// *Throws* Error{noSuchDevice} with the reason.
    SharedContext();
    ~SharedContext() override;
    SharedContext(const SharedContext &) = delete;
    SharedContext &operator=(const SharedContext &) = delete;

    void makeCurrent() override;
    void doneCurrent() override;

private:
    // Surfaces are deleted on the thread of the windows, contexts on the thread of their last use.
    std::unique_ptr<QOffscreenSurface> m_surface;
    std::unique_ptr<QOpenGLContext> m_context;
};

} // namespace pellucid::ui
