// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/gl_probe.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>

namespace pellucid::ui {

const std::optional<gpu::Capabilities> &windowCapabilities() {
    static const auto capabilities = []() -> std::optional<gpu::Capabilities> {
        // These have contexts, where there is a display, but no windows that show what they draw.
        const QStringList withoutSurfaces{"offscreen", "minimal", "linuxfb", "vnc"};
        if (withoutSurfaces.contains(QGuiApplication::platformName()))
            return std::nullopt;
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
