// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/look_rows.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

namespace {

using shading::CueKind;
using shading::Shading;

constexpr glm::dvec3 across{1, 0, 0}, oblique{1, 1, 0.7};

struct Case {
    const char *name;
    Shading shading;
};

std::vector<Case> cases() {
    const shading::DepthCue linear{CueKind::linear, 1.0}, half{CueKind::linear, 0.5};
    return {
        {"default no cue, no light", {}},
        {"default linear cue", {.cue = linear}},
        {"default linear cue, half", {.cue = half}},
        {"default sine cue", {.cue = {CueKind::sine, 1.0}}},
        {"default middle slab", {.cue = {CueKind::curve, 1.0, {0.0, 2.0, 0.0}}}},
        {"default one light", {.ambient = 0.3, .lights = {{across}}}},
        {"default three lights", {.ambient = 0.3, .lights = threeLights(false)}},
        {"default three lights of color", {.ambient = 0.3, .lights = threeLights(true)}},
        {"default linear cue and light", {.cue = linear, .ambient = 0.3, .lights = {{oblique}}}},
        {"default sine cue and light",
         {.cue = {CueKind::sine, 1.0}, .ambient = 0.3, .lights = {{oblique}}}}};
}

} // namespace

void runShadingSuite(const Report &report) {
    for (const int side : {128, 256}) {
        const LookSubject subject(side);
        const classify::ShownFields fields{{classify::densityField(subject.volume, subject.window)},
                                           {}};
        const auto plain = prepare::prepareEngine({subject.scene, fields});
        for (const auto &[name, shading] : cases()) {
            scene::Scene scene = subject.scene;
            scene.shading = shading;
            report(measureShaded("shading", name, fields, scene, *plain.engine).row);
        }
    }
}

} // namespace pellucid::bench
