// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/gl_probe.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>

namespace pellucid::ui {

const std::optional<gpu::Capabilities> &windowCapabilities() {
    static const auto capabilities = []() -> std::optional<gpu::Capabilities> {
        QOffscreenSurface surface;
        surface.create();
        QOpenGLContext context;
        if (!surface.isValid() || !context.create() || !context.makeCurrent(&surface))
            return std::nullopt;
        const gpu::Capabilities found = gpu::currentCapabilities();
        context.doneCurrent();
        return found;
    }();
    return capabilities;
}

} // namespace pellucid::ui
