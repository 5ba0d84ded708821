// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/measure/measurement.h"
#include "ui/document/region_marking.h"

namespace pellucid::ui {

/// The tool of the left mouse button in the panes. In the projection, the button orbits unless the
/// tool pans, zooms, measures (not a region of values) or marks regions. Their texts, keys and
/// buttons are in ui/window/actions/tool_commands.cpp.
enum class Tool {
    window,
    pan,
    zoom,
    crosshair,
    distance,
    polyline,
    angle,
    cobbAngle,
    ellipse,
    rectangle,
    arrow,
    text,
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

/// The tool that marks regions in this way; the window tool for none.
inline Tool toolFor(RegionTool wanted) {
    for (const Tool tool : {Tool::connected, Tool::paint, Tool::scissors})
        if (regionToolOf(tool) == wanted)
            return tool;
    return Tool::window;
}

inline bool marksRegions(Tool tool) {
    return regionToolOf(tool) != RegionTool::none;
}

/// The kind of measurement or annotation that a tool draws, if any.
inline std::optional<measure::Kind> measuredBy(Tool tool) {
    switch (tool) {
    case Tool::distance:
        return measure::Kind::distance;
    case Tool::polyline:
        return measure::Kind::polyline;
    case Tool::angle:
        return measure::Kind::angle;
    case Tool::cobbAngle:
        return measure::Kind::cobbAngle;
    case Tool::ellipse:
        return measure::Kind::ellipse;
    case Tool::rectangle:
        return measure::Kind::rectangle;
    case Tool::arrow:
        return measure::Kind::arrow;
    case Tool::text:
        return measure::Kind::text;
    default:
        return std::nullopt;
    }
}

} // namespace pellucid::ui
