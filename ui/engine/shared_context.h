// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "gpu/context.h"

class QOffscreenSurface;
class QOpenGLContext;

namespace pellucid::ui {

/// A context for the engine's own thread that shares textures with those of the windows. Made on
/// the thread of the user interface.
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
    // Surfaces go where windows live, contexts where they were last used.
    std::unique_ptr<QOffscreenSurface> m_surface;
    std::unique_ptr<QOpenGLContext> m_context;
};

} // namespace pellucid::ui
