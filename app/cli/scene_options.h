// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/render/scene.h"

namespace CLI {
class App;
}

namespace pellucid::cli {

/// The options that say what a projection shows, as typed.
struct SceneOptions {
    std::string scene, view, orientation, size, window, bezier, reconstruction, quality, kernel,
        storage;
    std::vector<std::string> classes;
    double azimuthDeg = 0.0, elevationDeg = 0.0, rollDeg = 0.0, pixelMm = 0.0, rollOff = -1.0,
           tolerance = 0.0, padding = 0.0;
};

/// Adds them to a command; `options` must outlive it.
void addSceneOptions(CLI::App &command, SceneOptions &options);

/// NAME of the standard classes. *Throws* Error{usage} with the names there are.
const classify::TissueClass &classNamed(const std::string &name);

/// The look that --bezier and --class ask for; what is not given is plain. *Throws* Error{usage}.
classify::Look lookFor(const SceneOptions &options);

/// The scene they make of a volume: the scene file's, or the default one, changed by the options
/// that were given. *Throws* Error{usage}, Error{unusable} for a scene file.
render::Scene sceneFor(const SceneOptions &options, const CLI::App &command,
                       const volume::Lattice &lattice);

} // namespace pellucid::cli
