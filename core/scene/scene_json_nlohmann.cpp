// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "core/classify/look_json.h"
#include "core/scene/scene.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;
using nlohmann::json;

// In version 1 "cubic", the default, was what is "spline" now: such scenes keep their pictures.
constexpr const char *schema = "pellucid-scene/2", *firstSchema = "pellucid-scene/1";

const std::map<std::string, Reconstruction> &reconstructionNames() {
    static const std::map<std::string, Reconstruction> names = {
        {"cubic", Reconstruction::cubic},
        {"linear", Reconstruction::linear},
        {"band-limited", Reconstruction::bandLimited},
        {"spline", Reconstruction::spline}};
    return names;
}

// The library's messages start with a tag of its own in brackets.
std::string withoutTag(const std::string &text) {
    const auto end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

std::string nameOf(Reconstruction value) {
    for (const auto &[name, candidate] : reconstructionNames())
        if (candidate == value)
            return name;
    return {};
}

} // namespace

std::string toJson(const Scene &scene) {
    const glm::dquat &q = scene.camera.orientation;
    json out = {{"schema", schema},
                {"camera",
                 {{"orientation", {q.w, q.x, q.y, q.z}},
                  {"pixel_mm", scene.camera.pixelMm},
                  {"size", {scene.camera.width, scene.camera.height}},
                  {"pan_mm", {scene.camera.panMm.x, scene.camera.panMm.y}}}},
                {"reconstruction", nameOf(scene.image.reconstruction)},
                {"roll_off", scene.image.rollOff},
                {"tolerance", scene.tolerance},
                {"tone", {{"inverted", scene.tone.inverted}}}};
    if (scene.plannedFor == PlannedFor::volume)
        out["planned_for"] = "volume";
    if (scene.fieldWindow)
        out["window"] = {scene.fieldWindow->low, scene.fieldWindow->high};
    out.update(json::parse(classify::toJson(scene.look)));
    out.update(json::parse(shading::toJson(scene.shading)));
    const auto list = [](const glm::dvec3 &v) { return json{v.x, v.y, v.z}; };
    if (!scene.crop.isWhole())
        out["crop"] = {{"low", list(scene.crop.low)}, {"high", list(scene.crop.high)}};
    if (scene.tone.low)
        out["tone"]["low"] = *scene.tone.low;
    if (scene.tone.high)
        out["tone"]["high"] = *scene.tone.high;
    const Interpolation &fixed = scene.interpolation;
    if (fixed.kernel)
        out["kernel"] = fourier::kernelName(*fixed.kernel);
    if (fixed.padding)
        out["padding"] = *fixed.padding;
    if (fixed.storage)
        out["storage"] = fourier::storageName(*fixed.storage);
    if (fixed.isUniform)
        out["uniform"] = true;
    return out.dump(2);
}

Scene sceneFromJson(const std::string &text) {
    Scene scene;
    try {
        const json in = json::parse(text);
        const bool isFirst = in.at("schema") == firstSchema;
        if (in.at("schema") != schema && !isFirst)
            throw task::Error(task::ErrorCode::usage, because::sceneHasOtherSchema(schema));
        const json &camera = in.at("camera");
        const auto q = camera.at("orientation").get<std::array<double, 4>>();
        scene.camera.orientation = glm::dquat(q[0], q[1], q[2], q[3]);
        scene.camera.pixelMm = camera.at("pixel_mm");
        // As numbers first: one that is no integer has no meaning as one; 0 is refused below.
        const auto size = camera.at("size").get<std::array<double, 2>>();
        const auto pixels = [](double n) {
            return n >= 1.0 && n <= largestImageSize && n == std::floor(n) ? int(n) : 0;
        };
        scene.camera.width = pixels(size[0]);
        scene.camera.height = pixels(size[1]);
        const auto pan = camera.value("pan_mm", std::array<double, 2>{0.0, 0.0});
        scene.camera.panMm = {pan[0], pan[1]};
        if (in.contains("window")) {
            const auto window = in.at("window").get<std::array<double, 2>>();
            scene.fieldWindow = classify::FieldWindow{window[0], window[1]};
        }
        scene.look = classify::lookFromJson(text);
        scene.shading = shading::shadingFromJson(text);
        if (in.contains("crop")) {
            const auto low = in.at("crop").at("low").get<std::array<double, 3>>();
            const auto high = in.at("crop").at("high").get<std::array<double, 3>>();
            scene.crop = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
        }
        const std::string reconstruction = in.value("reconstruction", "cubic");
        const auto it = reconstructionNames().find(reconstruction);
        if (it == reconstructionNames().end())
            throw task::Error(task::ErrorCode::usage,
                              because::unknownReconstruction(reconstruction));
        scene.image.reconstruction =
            isFirst && it->second == Reconstruction::cubic ? Reconstruction::spline : it->second;
        scene.image.rollOff = in.value("roll_off", scene.image.rollOff);
        scene.tolerance = in.value("tolerance", scene.tolerance);
        const std::string plannedFor = in.value("planned_for", "picture");
        if (plannedFor != "picture" && plannedFor != "volume")
            throw task::Error(task::ErrorCode::usage, because::plannedForOther);
        scene.plannedFor = plannedFor == "volume" ? PlannedFor::volume : PlannedFor::picture;
        if (in.contains("kernel"))
            scene.interpolation.kernel = fourier::kernelFromName(in.at("kernel"));
        if (in.contains("padding"))
            scene.interpolation.padding = in.at("padding").get<double>();
        if (in.contains("storage"))
            scene.interpolation.storage = fourier::storageFromName(in.at("storage"));
        scene.interpolation.isUniform = in.value("uniform", false);
        if (in.contains("tone")) {
            const json &tone = in.at("tone");
            scene.tone.inverted = tone.value("inverted", false);
            if (tone.contains("low"))
                scene.tone.low = tone.at("low").get<double>();
            if (tone.contains("high"))
                scene.tone.high = tone.at("high").get<double>();
        }
    } catch (const json::exception &error) {
        throw task::Error(task::ErrorCode::usage,
                          because::sceneIsNotValid(withoutTag(error.what())));
    }
    validate(scene);
    // One that is of length 1 stays bit for bit: a kept scene gives the same picture.
    constexpr double rounding = 1e-12;
    if (glm::dquat &q = scene.camera.orientation; std::abs(glm::dot(q, q) - 1.0) > rounding)
        q = glm::normalize(q);
    return scene;
}

} // namespace pellucid::scene
