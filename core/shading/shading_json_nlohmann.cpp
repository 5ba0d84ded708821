// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "core/classify/reasons.h"
#include "core/files/json_value_nlohmann.h"
#include "core/files/reasons.h"
#include "core/shading/reasons.h"
#include "core/shading/shading_json_nlohmann.h"

namespace pellucid::shading {

namespace {

namespace because = task::because;
using files::JsonValue;
using files::JsonWords;
using files::wordFor;
using nlohmann::json;

constexpr JsonWords<CueKind, 4> cueKinds{{{"none", CueKind::none},
                                          {"linear", CueKind::linear},
                                          {"sine", CueKind::sine},
                                          {"curve", CueKind::curve}}};
constexpr JsonWords<LightFrame, 2> frames{
    {{"viewer", LightFrame::viewer}, {"patient", LightFrame::patient}}};

DepthCue cueFrom(const JsonValue &in) {
    if (!in["kind"])
        in.refuse(because::mustHaveAKind);
    DepthCue cue;
    cue.kind = in["kind"].meaning(cueKinds);
    if (const JsonValue strength = in["strength"])
        cue.strength = strength.number();
    if (const JsonValue curve = in["curve"])
        cue.curve = curve.numbers();
    in.checked([&] { validate(Shading{.cue = cue}); });
    return cue;
}

double ambientFrom(const JsonValue &in) {
    const double ambient = in.number();
    in.checked([&] { validate(Shading{.ambient = ambient}); });
    return ambient;
}

Light lightFrom(const JsonValue &in) {
    if (!in["direction"])
        in.refuse(because::mustHaveADirection);
    Light light;
    const auto [u, v, w] = in["direction"].threeNumbers();
    light.direction = {u, v, w};
    if (const JsonValue color = in["color"]) {
        const std::string text = color.text();
        light.color = color.checked([&] { return classify::colorFromText(text); });
    }
    if (const JsonValue strength = in["strength"])
        light.strength = strength.number();
    if (const JsonValue follows = in["follows"])
        light.frame = follows.meaning(frames);
    in.checked([&] { validate(Shading{.lights = {light}}); });
    return light;
}

} // namespace

json jsonOf(const Shading &shading) {
    json out = json::object();
    const DepthCue &cue = shading.cue;
    if (cue != DepthCue()) {
        out["cue"] = {{"kind", wordFor(cue.kind, cueKinds)}, {"strength", cue.strength}};
        if (cue.curve != DepthCue().curve)
            out["cue"]["curve"] = cue.curve;
    }
    if (shading.ambient != 1.0)
        out["ambient"] = shading.ambient;
    for (const Light &light : shading.lights)
        out["lights"].push_back(
            {{"direction", {light.direction.x, light.direction.y, light.direction.z}},
             {"color", classify::colorText(light.color)},
             {"strength", light.strength},
             {"follows", wordFor(light.frame, frames)}});
    return out;
}

Shading shadingFrom(const JsonValue &in) {
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    Shading shading;
    if (const JsonValue cue = in["cue"])
        shading.cue = cueFrom(cue);
    if (const JsonValue ambient = in["ambient"])
        shading.ambient = ambientFrom(ambient);
    if (const JsonValue lights = in["lights"]) {
        if (lights.size() > maxLights)
            lights.refuse(because::holdsTooManyLights(maxLights));
        for (const JsonValue &light : lights.elements())
            shading.lights.push_back(lightFrom(light));
    }
    return shading;
}

} // namespace pellucid::shading
