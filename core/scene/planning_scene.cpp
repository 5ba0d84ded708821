// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/planning_scene.h"

#include <algorithm>
#include <cmath>

namespace pellucid::scene {

// Strength and values are rounded to halves, away from the value without effect.
shading::DepthCue plannedCue(const shading::DepthCue &cue) {
    if (!cue.isActive())
        return {};
    shading::DepthCue planned{cue.kind, std::ceil(2.0 * cue.strength) / 2.0};
    if (cue.kind == shading::CueKind::curve) {
        planned.curve = cue.curve;
        for (double &value : planned.curve)
            value = (value < 1.0 ? std::floor(2.0 * value) : std::ceil(2.0 * value)) / 2.0;
    }
    return planned;
}

Scene planningScene(const Scene &scene, const volume::Lattice &lattice) {
    if (scene.plannedFor == PlannedFor::picture)
        return scene;
    Scene planning;
    planning.plannedFor = scene.plannedFor;
    planning.tolerance = scene.tolerance;
    planning.interpolation = scene.interpolation;
    planning.image = scene.image;
    planning.shading.cue = plannedCue(scene.shading.cue);
    if (scene.shading.isLit()) // their number and place cost nothing, colors a little
        planning.shading.lights.push_back({.color = {1.0, 0.5, 0.0}});
    planning.camera.pixelMm = lattice.shortestStepMm();
    planning.camera.width = planning.camera.height =
        int(std::clamp(2.0 * lattice.radiusMm() / planning.camera.pixelMm, 2.0, 4096.0));
    return planning;
}

} // namespace pellucid::scene
