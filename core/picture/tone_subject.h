// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/scene/scene.h"

namespace pellucid::picture {

/// The properties that an exposure depends on: all that change the projected values or their
/// contrast. The view is not one of them, nor is the strength of a cue or a light, which the user
/// drags.
struct ToneSubject {
    ToneSubject() = default;
    explicit ToneSubject(const scene::Scene &scene)
        : look(scene.look), fieldWindow(scene.fieldWindow), crop(scene.crop),
          lights(scene.shading.lights.size()), cue(scene.shading.cue.kind),
          detail(scene.tone.detail), latitude(scene.tone.latitude), filter(scene.image.detail),
          filterMm(scene.image.detailMm) {}

    classify::Look look;
    std::optional<classify::FieldWindow> fieldWindow;
    classify::CropBox crop;
    std::size_t lights = 0;
    shading::CueKind cue = shading::CueKind::none;
    std::optional<double> detail, latitude; ///< of multi-scale contrast
    double filter = 0.0, filterMm = 0.0;    ///< of the linear filter
    bool operator==(const ToneSubject &) const = default;
};

} // namespace pellucid::picture
