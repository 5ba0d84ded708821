// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "core/classify/json_values_nlohmann.h"
#include "core/shading/shading.h"
#include "core/task/error.h"

namespace pellucid::shading {

namespace {

namespace because = task::because;
using classify::jsonNumber;
using classify::jsonNumbers;
using classify::jsonText;
using classify::refuseJson;
using nlohmann::json;

constexpr std::array<std::pair<const char *, CueKind>, 4> cueKinds{{{"none", CueKind::none},
                                                                    {"linear", CueKind::linear},
                                                                    {"sine", CueKind::sine},
                                                                    {"curve", CueKind::curve}}};
constexpr std::array<std::pair<const char *, LightFrame>, 2> frames{
    {{"viewer", LightFrame::viewer}, {"patient", LightFrame::patient}}};

template <class Names> auto valueNamed(const Names &names, const json &in, const std::string &at) {
    const std::string name = jsonText(in, at);
    std::string all;
    for (const auto &[known, value] : names) {
        if (name == known)
            return value;
        all += (all.empty() ? "" : ", ") + std::string(known);
    }
    refuseJson(at, because::isNoneOf(name, all));
}

template <class Names, class T> const char *nameIn(const Names &names, T value) {
    return std::find_if(names.begin(), names.end(),
                        [&](const auto &pair) { return pair.second == value; })
        ->first;
}

DepthCue cueFromJson(const json &in) {
    if (!in.is_object() || !in.contains("kind"))
        refuseJson("/cue", because::mustHaveAKind);
    DepthCue cue;
    cue.kind = valueNamed(cueKinds, in["kind"], "/cue/kind");
    if (in.contains("strength"))
        cue.strength = jsonNumber(in["strength"], "/cue/strength");
    if (in.contains("curve"))
        cue.curve = jsonNumbers(in["curve"], "/cue/curve");
    return cue;
}

Light lightFromJson(const json &in, const std::string &at) {
    if (!in.is_object() || !in.contains("direction"))
        refuseJson(at, because::mustHaveADirection);
    Light light;
    const auto direction = jsonNumbers(in["direction"], at + "/direction");
    if (direction.size() != 3)
        refuseJson(at + "/direction", because::mustBeThreeNumbers);
    light.direction = {direction[0], direction[1], direction[2]};
    if (in.contains("color")) {
        const std::string color = jsonText(in["color"], at + "/color");
        try {
            light.color = classify::colorFromText(color);
        } catch (const task::Error &error) {
            refuseJson(at + "/color", error.reason());
        }
    }
    if (in.contains("strength"))
        light.strength = jsonNumber(in["strength"], at + "/strength");
    if (in.contains("follows"))
        light.frame = valueNamed(frames, in["follows"], at + "/follows");
    return light;
}

// What validating says of a part, said of where the part stands.
void check(const Shading &part, const std::string &at) {
    try {
        validate(part);
    } catch (const task::Error &error) {
        refuseJson(at, error.reason());
    }
}

} // namespace

std::string toJson(const Shading &shading) {
    json out = json::object();
    const DepthCue &cue = shading.cue;
    if (cue != DepthCue()) {
        out["cue"] = {{"kind", nameIn(cueKinds, cue.kind)}, {"strength", cue.strength}};
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
             {"follows", nameIn(frames, light.frame)}});
    return out.dump();
}

Shading shadingFromJson(const std::string &text) {
    const json in = json::parse(text, nullptr, false);
    if (!in.is_object())
        refuseJson("", because::mustBeAnObject);
    Shading shading;
    if (in.contains("cue")) {
        shading.cue = cueFromJson(in["cue"]);
        check({.cue = shading.cue}, "/cue");
    }
    if (in.contains("ambient")) {
        shading.ambient = jsonNumber(in["ambient"], "/ambient");
        check({.ambient = shading.ambient}, "/ambient");
    }
    if (in.contains("lights")) {
        if (!in["lights"].is_array())
            refuseJson("/lights", because::mustBeAList);
        if (in["lights"].size() > mostLights)
            refuseJson("/lights", because::holdsTooManyLights(mostLights));
        for (std::size_t n = 0; n < in["lights"].size(); ++n) {
            const std::string at = "/lights/" + std::to_string(n);
            shading.lights.push_back(lightFromJson(in["lights"][n], at));
            check({.lights = {shading.lights.back()}}, at);
        }
    }
    return shading;
}

} // namespace pellucid::shading
