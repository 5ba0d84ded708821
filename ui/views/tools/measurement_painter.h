// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ui/document/document.h"
#include "ui/views/tools/pane_tool.h"

namespace pellucid::ui {

/// A measurement with its result, and whether it is selected.
struct DrawnMeasurement {
    const Measured &measured;
    bool isSelected;
};

/// Draws measurements and their results. Texts do not overlap each other and, if there is room, do
/// not cover figures.
void paintMeasurements(QPainter &painter, const ToolSurface &surface,
                       const std::vector<DrawnMeasurement> &drawn, const volume::Volume &volume);

/// Draws a measurement without its result.
void paintMeasurement(QPainter &painter, const PaneMapping &mapping,
                      const measure::Measurement &measurement, const QColor &color,
                      bool isSelected);

} // namespace pellucid::ui
