// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/tools/tone_tool.h"

#include <algorithm>

#include <QCoreApplication>

namespace pellucid::ui {

bool ToneTool::press(const QPointF & /*at*/) {
    m_drag = nextDragId();
    return true;
}

bool ToneTool::move(const MouseMove &mouse) {
    const picture::ToneRange automatic = m_pane.automaticRange();
    const auto [low, high] = m_pane.shownRange();
    const double perPixel = (automatic.high - automatic.low) / 300.0;
    const double center = 0.5 * (low + high) - mouse.delta.y() * perPixel;
    const double width = std::max(high - low + mouse.delta.x() * perPixel, 2.0 * perPixel);
    editScene(m_document, QCoreApplication::translate("ToneTool", "Projection window"), m_drag,
              [&](scene::Scene &scene) {
                  scene.tone.low = center - 0.5 * width;
                  scene.tone.high = center + 0.5 * width;
              });
    return true;
}

} // namespace pellucid::ui
