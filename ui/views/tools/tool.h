// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/measure/measurement.h"
#include "ui/document/region_marking.h"

namespace pellucid::ui {

/// The tool of the left mouse button in the panes. In the projection, the button orbits unless the
/// tool is `distance` or marks regions. ToolsMenu::addTools lists the tools in the same order.
enum class Tool {
    window,
    pan,
    zoom,
    crosshair,
    distance,
    angle,
    ellipse,
    rectangle,
    crop,
    connected,
    paint,
    scissors
};

/// How a tool marks regions, if it does.
inline RegionTool regionToolOf(Tool tool) {
    switch (tool) {
    case Tool::connected:
        return RegionTool::connected;
    case Tool::paint:
        return RegionTool::paint;
    case Tool::scissors:
        return RegionTool::scissors;
    default:
        return RegionTool::none;
    }
}

inline bool marksRegions(Tool tool) {
    return regionToolOf(tool) != RegionTool::none;
}

/// The kind of measurement that a tool draws, if any.
inline std::optional<measure::Kind> measuredBy(Tool tool) {
    switch (tool) {
    case Tool::distance:
        return measure::Kind::distance;
    case Tool::angle:
        return measure::Kind::angle;
    case Tool::ellipse:
        return measure::Kind::ellipse;
    case Tool::rectangle:
        return measure::Kind::rectangle;
    default:
        return std::nullopt;
    }
}

} // namespace pellucid::ui
