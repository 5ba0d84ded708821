// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

namespace pellucid::scene {

/// The scene that an engine is planned for. If the scene is planned for the volume, this is a
/// picture of the whole volume for any camera, with the cue of `plannedCue` and, if there are
/// lights, with light: one engine then serves every view, and two programs make the same picture of
/// one scene. A scene that is planned for its picture is returned unchanged.
Scene planningScene(const Scene &scene, const volume::Lattice &lattice);

/// A cue at least as strong as `cue`, in coarse steps, so that small changes need no new plan.
shading::DepthCue plannedCue(const shading::DepthCue &cue);

} // namespace pellucid::scene
