// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/prepared_for.h"

#include "core/classify/layers.h"
#include "core/scene/planning_scene.h"

namespace pellucid::prepare {

PreparedFor::PreparedFor(const scene::Scene &scene)
    : window(scene.fieldWindow), look(scene.look), crop(scene.crop), tolerance(scene.tolerance),
      interpolation(scene.interpolation), image(scene.image),
      cue(scene::plannedCue(scene.shading.cue)), isLit(scene.shading.isLit()) {}

bool PreparedFor::hasSameLayersAs(const PreparedFor &other) const {
    if (!(window == other.window && crop == other.crop && tolerance == other.tolerance &&
          interpolation == other.interpolation && image == other.image && cue == other.cue &&
          isLit == other.isLit))
        return false;
    if (look == other.look)
        return true;
    std::optional<std::size_t> adjusted = adjustedClass ? adjustedClass : other.adjustedClass;
    if (!adjusted)
        adjusted = classify::onlyDifference(look, other.look);
    return classify::mixtureOf(look, adjusted).layers ==
           classify::mixtureOf(other.look, adjusted).layers;
}

bool PreparedFor::showsSameAs(const PreparedFor &other) const {
    return window == other.window && look == other.look && crop == other.crop &&
           tolerance == other.tolerance && interpolation == other.interpolation;
}

} // namespace pellucid::prepare
