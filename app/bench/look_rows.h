// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/bench/suites.h"
#include "core/classify/look.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

/// The volume of a head with a window and a view, for measuring looks.
struct LookSubject {
    explicit LookSubject(int side);
    volume::Volume volume;
    classify::FieldWindow window;
    scene::Scene scene;
};

/// Reports three rows for a look: with fixed weights, one spectrum per channel of the sum; while
/// weights and view move, slices of the layers summed; while only weights move, the stored
/// projections recombined. Errors are relative to the exact projection of the sum, in one view, all
/// channels together.
void reportLook(const Report &report, const std::string &suite, const std::string &name,
                const LookSubject &subject, const classify::Look &look, const std::string &note);

/// Two classes, each in its color.
classify::Look boneAndSoftTissue();

/// Three lights across the view, 120 degrees apart, as in figure 8 of Totsuka 1993; white or in its
/// colors.
std::vector<shading::Light> threeLights(bool colored);

/// A shaded scene, ready to render, and its row.
struct ShadedFrames {
    Row row;
    prepare::PreparedEngine prepared;
};
/// Times frames of a scene with cue and lights, alternating with those of a plain engine. The error
/// is that of one general view, against the exact shaded image.
ShadedFrames measureShaded(const std::string &suite, const std::string &name,
                           const classify::ShownFields &fields, const scene::Scene &scene,
                           render::ProjectionEngine &plain);

} // namespace pellucid::bench
