// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/presets/preset.h"
#include "core/shading/shading.h"

namespace CLI {
class App;
}

namespace pellucid::cli {

struct SceneOptions;

/// NAME of the standard classes. *Throws* Error{usage} with the names there are.
const classify::TissueClass &classNamed(const std::string &name);

/// The preset that --preset names, a file's or one of the library, which is read for it: a command
/// asks once. *Throws* Error{usage}, Error{unusable}.
std::optional<presets::Preset> presetFor(const SceneOptions &options);

/// Changes a look by --bezier, a curve that shows the whole volume, and --class, which show
/// themselves alone. *Throws* Error{usage}.
void changeLook(classify::Look &look, const SceneOptions &options);

/// The look that the preset, --bezier and --class ask for, in the preset's own units; what is not
/// given is plain. *Throws* Error{usage}.
classify::Look lookFor(const SceneOptions &options, const std::optional<presets::Preset> &preset);

/// The cue and lights that the preset, --depth-cue, --light and --ambient ask for, over `former`
/// where they are not given. *Throws* Error{usage}.
shading::Shading shadingFor(const SceneOptions &options, const CLI::App &command,
                            const std::optional<presets::Preset> &preset,
                            const shading::Shading &former = {});

} // namespace pellucid::cli
