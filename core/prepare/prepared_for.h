// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scene/scene.h"

namespace pellucid::prepare {

/// What of a scene an engine is made for; the rest changes from frame to frame.
struct PreparedFor {
    PreparedFor() = default;
    /// With the window only if the scene names one.
    explicit PreparedFor(const scene::Scene &scene);
    std::optional<classify::FieldWindow> window; ///< none: the volume's own
    classify::Look look;
    classify::CropBox crop;
    double tolerance = 0.0;
    scene::Interpolation interpolation;
    scene::ImageDefinition image;
    /// The cue that the error is planned for: as strong as it is, or a little stronger, so that not
    /// every touch asks for a new plan.
    shading::DepthCue cue;
    bool isLit = false;
    bool operator==(const PreparedFor &) const = default;

    /// Whether only weights, colours and control points differ: the layers are the same.
    bool hasLayersOf(const PreparedFor &other) const;
    /// Whether only cue, light and what lies between samples differ, which are seen with any
    /// engine.
    bool showsSameAs(const PreparedFor &other) const;
};

} // namespace pellucid::prepare
