// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/bench/suites.h"
#include "core/classify/look.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

/// A head with its values, for looks, and how it is seen.
struct LookSubject {
    explicit LookSubject(int side);
    volume::Volume volume;
    classify::FieldWindow window;
    scene::Scene scene;
};

/// Three rows for a look: one spectrum each channel of the sum, while weights stand still; the
/// layers summed, while weights and view move; and the kept projections recombined, while the view
/// stands still. Errors against the exact projections of the sum, from one view; of all channels.
void reportLook(const Report &report, const std::string &suite, const std::string &name,
                const LookSubject &subject, const classify::Look &look, const std::string &note);

/// Lights across the view, 120 degrees apart: figure 8 of Totsuka 1993, in white or in its colours.
std::vector<shading::Light> threeLights(bool colored);

/// A shaded scene, ready to render, and its row.
struct ShadedFrames {
    Row row;
    prepare::PreparedEngine prepared;
};
/// Times the frames of a scene with cue and lights in turns with those of a plain engine. The error
/// is that of one general view, against the exact shaded image.
ShadedFrames measureShaded(const std::string &suite, const std::string &name,
                           const classify::ShownFields &fields, const scene::Scene &scene,
                           render::ProjectionEngine &plain);

} // namespace pellucid::bench
