// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/presets/preset.h"
#include "core/scene/scene.h"
#include "core/segment/segment_set.h"

namespace CLI {
class App;
}

namespace pellucid::cli {

/// The options for what a projection shows, as typed.
struct SceneOptions {
    bool isInverted = false, isWithoutCouch = false;
    std::string carm, contrast, detail, scene, preset, view, orientation, size, window, bezier,
        bezierRange, reconstruction, quality, kernel, storage, depthCue, lightFrame, crop;
    bool isUniform = false, weightsAreOptional = false; ///< the latter: of --class
    std::vector<std::string> classes, lights, segmentations, segments, points;
    double azimuthDeg = 0.0, elevationDeg = 0.0, rollDeg = 0.0, pixelMm = 0.0, rollOff = -1.0,
           tolerance = 0.0, padding = 0.0, ambient = 1.0;
};

/// Adds these options to a command. *Requires*: `options` outlives it.
void addSceneOptions(CLI::App &command, SceneOptions &options);

/// The scene that the options ask for: the scene file's, or else the default one, changed by the
/// preset and then by the options that are given. `segments`: null if none are loaded. *Throws*
/// Error{usage}; Error{unusable} for a file.
scene::Scene sceneFor(const SceneOptions &options, const CLI::App &command,
                      const std::optional<presets::Preset> &preset, const volume::Volume &volume,
                      const segment::SegmentSet *segments);

} // namespace pellucid::cli
