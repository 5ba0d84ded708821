// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/presets/preset.h"
#include "core/shading/shading.h"

namespace CLI {
class App;
}

namespace pellucid::cli {

struct SceneOptions;

/// The standard class of a name. *Throws* Error{usage} with the known names.
const classify::TissueClass &classNamed(const std::string &name);

/// The preset that --preset names: a file, or a preset of the library. It reads the file or the
/// library each time. *Throws* Error{usage}, Error{unusable}.
std::optional<presets::Preset> presetFor(const SceneOptions &options);

/// Applies --bezier, a curve for the whole volume, or --class, which show only these classes, to a
/// look. *Throws* Error{usage}.
void changeLook(classify::Look &look, const SceneOptions &options);

/// Adds the points of --point to the steps that take them. *Throws* Error{usage} for a class that
/// the look does not have or that takes no points, for a point outside the volume, and for a class
/// without the points that it needs.
void addPoints(classify::Look &look, const std::vector<std::string> &points,
               const volume::Lattice &lattice);
/// The option --point. *Requires*: `points` outlives the command.
void addPointOption(CLI::App &command, std::vector<std::string> &points);

/// The look of the preset, or else the default look, changed by --bezier and --class; in the
/// preset's own units. *Throws* Error{usage}.
classify::Look lookFor(const SceneOptions &options, const std::optional<presets::Preset> &preset);

/// The cue and lights of the preset, or else of `former`, changed by --depth-cue, --light and
/// --ambient. *Throws* Error{usage}.
shading::Shading shadingFor(const SceneOptions &options, const CLI::App &command,
                            const std::optional<presets::Preset> &preset,
                            const shading::Shading &former = {});

} // namespace pellucid::cli
