// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/gl_probe.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>

#include "core/platform/display.h"

namespace pellucid::ui {

const std::optional<gpu::Capabilities> &windowCapabilities() {
    static const auto capabilities = []() -> std::optional<gpu::Capabilities> {
        // With a display these have contexts, but no windows that show the drawing.
        const QStringList withoutSurfaces{"offscreen", "minimal", "linuxfb", "vnc"};
        if (withoutSurfaces.contains(QGuiApplication::platformName()))
            return std::nullopt;
        // libepoxy looks up the context there, and ends the program if it is missing.
        if (!platform::windowsHaveOpenGl())
            return std::nullopt;
        QOffscreenSurface surface;
        surface.create();
        QOpenGLContext context;
        if (!surface.isValid() || !context.create() || !context.makeCurrent(&surface))
            return std::nullopt;
        gpu::contextHasChanged();
        const gpu::Capabilities found = gpu::currentCapabilities();
        context.doneCurrent();
        return found;
    }();
    return capabilities;
}

} // namespace pellucid::ui
