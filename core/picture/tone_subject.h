// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/scene/scene.h"

namespace pellucid::picture {

/// The properties that an automatic brightness depends on: all that change the projected values
/// themselves. The view is not one of them, nor is the strength of a cue or a light, which the user
/// drags.
struct ToneSubject {
    ToneSubject() = default;
    explicit ToneSubject(const scene::Scene &scene)
        : look(scene.look), fieldWindow(scene.fieldWindow), crop(scene.crop),
          lights(scene.shading.lights.size()), cue(scene.shading.cue.kind) {}

    classify::Look look;
    std::optional<classify::FieldWindow> fieldWindow;
    classify::CropBox crop;
    std::size_t lights = 0;
    shading::CueKind cue = shading::CueKind::none;
    bool operator==(const ToneSubject &) const = default;
};

} // namespace pellucid::picture
