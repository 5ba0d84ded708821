// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shading/shading_json_nlohmann.h"

#include "core/classify/look_json_nlohmann.h"
#include "core/files/json_fields_nlohmann.h"
#include "core/shading/reasons.h"

namespace pellucid::shading {

using files::JsonFields;
using files::JsonWords;

static constexpr JsonWords<CueKind, 4> cueKinds{{{"none", CueKind::none},
                                                 {"linear", CueKind::linear},
                                                 {"sine", CueKind::sine},
                                                 {"curve", CueKind::curve}}};
static const JsonWords<CueKind, 4> &jsonWords(CueKind) {
    return cueKinds;
}

static constexpr JsonWords<LightFrame, 2> frames{
    {{"viewer", LightFrame::viewer}, {"patient", LightFrame::patient}}};
static const JsonWords<LightFrame, 2> &jsonWords(LightFrame) {
    return frames;
}

static void fields(JsonFields &io, DepthCue &cue) {
    io.required("kind", cue.kind);
    io.known("strength", cue.strength);
    io.unusual("curve", cue.curve, DepthCue().curve);
}

static void fields(JsonFields &io, Light &light) {
    io.required("direction", light.direction);
    io.known("color", light.color);
    io.known("strength", light.strength);
    io.known("follows", light.frame);
}

void fields(JsonFields &io, Shading &shading) {
    io.unusual("cue", shading.cue);
    io.unusual("ambient", shading.ambient, 1.0);
    io.checked("ambient", [&] { validate(Shading{.ambient = shading.ambient}); });
    io.unusual("lights", shading.lights);
    io.checked("lights", [&] { validate(shading); });
}

nlohmann::json jsonOf(const Shading &shading) {
    return JsonFields::written(shading);
}

} // namespace pellucid::shading
