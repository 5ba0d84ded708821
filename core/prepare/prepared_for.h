// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scene/scene.h"

namespace pellucid::prepare {

/// The part of a scene that an engine is made for; the rest may change from frame to frame.
struct PreparedFor {
    PreparedFor() = default;
    /// Has a window only if the scene has one.
    explicit PreparedFor(const scene::Scene &scene);
    std::optional<classify::FieldWindow> window; ///< not set: the volume's own
    classify::Look look;
    classify::CropBox crop;
    double tolerance = 0.0;
    scene::Interpolation interpolation;
    scene::ImageDefinition image;
    /// The cue that the error is planned for. It is rounded up, so that not every small change
    /// needs a new plan.
    shading::DepthCue cue;
    bool isLit = false;
    /// Set for layers of many classes: the class that is a layer of its own, see
    /// `classify::mixtureOf`.
    std::optional<std::size_t> adjustedClass;
    bool operator==(const PreparedFor &) const = default;

    /// Whether only weights, colors and control points differ: the layers are the same. If the look
    /// has many classes, only one of them may differ: the adjusted one.
    bool hasSameLayersAs(const PreparedFor &other) const;
    /// Whether only cue, light and interpolation between samples differ, which any engine can show.
    bool showsSameAs(const PreparedFor &other) const;
};

} // namespace pellucid::prepare
