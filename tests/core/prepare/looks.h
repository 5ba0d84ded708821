// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/prepare/next_step.h"

namespace pellucid::test {

using prepare::PreparedFor;
using prepare::Underway;

/// The default look; one with other weights; one with other layers; and with light, with a cue.
enum Look { plain, weighted, classes, lit, litWeighted, cued, litCued, looks };

inline PreparedFor madeFor(Look look) {
    PreparedFor made;
    made.tolerance = 1e-3;
    if (look == weighted || look == litWeighted)
        made.look.transferFunction.weights[2] = 0.5;
    if (look == classes)
        made.look.classes.push_back({.name = "Bone", .low = 200.0, .high = 3000.0});
    if (look == cued || look == litCued)
        made.cue.kind = shading::CueKind::linear;
    made.isLit = look == lit || look == litWeighted || look == litCued;
    return made;
}

inline Underway engineOf(Look look) {
    return {Underway::Makes::engine, madeFor(look)};
}
inline Underway coarseFirstOf(Look look) {
    return {Underway::Makes::engine, madeFor(look), true};
}
inline Underway layersOf(Look look) {
    return {Underway::Makes::layers, madeFor(look)};
}

} // namespace pellucid::test
