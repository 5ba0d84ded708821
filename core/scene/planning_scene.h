// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

namespace pellucid::scene {

/// What an engine is planned for where the scene says for the whole volume: all of it in a picture
/// of its own, whatever the camera, with the cue of `plannedCue` and, under light, any lights. So
/// an engine serves every view, and two programs that are given one scene make the same picture.
/// A scene that is planned for its picture comes back as it is.
Scene planningScene(const Scene &scene, const volume::Lattice &lattice);

/// A cue as strong, or a little stronger, so that not every touch asks for a new plan.
shading::DepthCue plannedCue(const shading::DepthCue &cue);

} // namespace pellucid::scene
