// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/classify/look_json_nlohmann.h"
#include "core/classify/reasons.h"
#include "core/files/json_value_nlohmann.h"
#include "core/files/reasons.h"
#include "core/scene/reasons.h"
#include "core/scene/scene_json_nlohmann.h"
#include "core/shading/shading_json_nlohmann.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;
using files::JsonValue;
using files::JsonWords;
using files::wordFor;
using nlohmann::json;

constexpr const char *schema = "pellucid-scene/3";

constexpr JsonWords<Reconstruction, 4> reconstructions{
    {{"cubic", Reconstruction::cubic},
     {"linear", Reconstruction::linear},
     {"band-limited", Reconstruction::bandLimited},
     {"spline", Reconstruction::spline}}};
constexpr JsonWords<PlannedFor, 2> plannedFors{
    {{"picture", PlannedFor::picture}, {"volume", PlannedFor::volume}}};

Camera cameraFrom(const JsonValue &in) {
    Camera camera;
    const auto [w, x, y, z] = in.at("orientation").fourNumbers();
    camera.orientation = glm::dquat(w, x, y, z);
    camera.pixelMm = in.at("pixel_mm").number();
    // `validate` refuses 0.
    const auto pixels = [](double n) {
        return n >= 1.0 && n <= largestImageSize && n == std::floor(n) ? int(n) : 0;
    };
    const auto [width, height] = in.at("size").twoNumbers();
    camera.width = pixels(width);
    camera.height = pixels(height);
    if (const JsonValue pan = in["pan_mm"]) {
        const auto [right, up] = pan.twoNumbers();
        camera.panMm = {right, up};
    }
    return camera;
}

classify::CropBox cropFrom(const JsonValue &in) {
    const auto corner = [&](const char *name) {
        const auto [x, y, z] = in.at(name).threeNumbers();
        return glm::dvec3(x, y, z);
    };
    return {corner("low"), corner("high")};
}

ImageDefinition imageFrom(const JsonValue &in) {
    ImageDefinition image;
    if (const JsonValue reconstruction = in["reconstruction"])
        image.reconstruction = reconstruction.meaning(reconstructions);
    if (const JsonValue rollOff = in["roll_off"])
        image.rollOff = rollOff.number();
    if (const JsonValue detail = in["detail"])
        image.detail = detail.number();
    if (const JsonValue size = in["detail_mm"])
        image.detailMm = size.number();
    return image;
}

Interpolation interpolationFrom(const JsonValue &in) {
    Interpolation fixed;
    if (const JsonValue kernel = in["kernel"]) {
        const std::string name = kernel.text();
        fixed.kernel = kernel.checked([&] { return fourier::kernelFromName(name); });
    }
    if (const JsonValue padding = in["padding"])
        fixed.padding = padding.number();
    if (const JsonValue storage = in["storage"]) {
        const std::string name = storage.text();
        fixed.storage = storage.checked([&] { return fourier::storageFromName(name); });
    }
    if (const JsonValue uniform = in["uniform"])
        fixed.isUniform = uniform.boolean();
    return fixed;
}

Exposure exposureFrom(const JsonValue &in) {
    Exposure exposure;
    exposure.detail = in.at("detail").number();
    exposure.latitude = in.at("latitude").number();
    exposure.fineMm = in.at("fine_mm").number();
    const auto corner = [&](const char *name) {
        const auto [x, y, z] = in.at(name).threeNumbers();
        return glm::dvec3(x, y, z);
    };
    exposure.lowMm = corner("low_mm");
    exposure.highMm = corner("high_mm");
    const JsonValue axes = in.at("axes");
    for (std::size_t n = 0; n < exposure.axes.size(); ++n) {
        const JsonValue axis = axes.at(n);
        exposure.axes[n] = {axis.at("air").number(),    axis.at("dark").number(),
                            axis.at("bright").number(), axis.at("low").number(),
                            axis.at("high").number(),   axis.at("exponent").number()};
    }
    in.checked([&] { validate(exposure); });
    return exposure;
}

json jsonOf(const Exposure &exposure) {
    json axes = json::array();
    for (const Exposure::Axis &axis : exposure.axes)
        axes.push_back({{"air", axis.air},
                        {"dark", axis.dark},
                        {"bright", axis.bright},
                        {"low", axis.low},
                        {"high", axis.high},
                        {"exponent", axis.exponent}});
    return {{"detail", exposure.detail},
            {"latitude", exposure.latitude},
            {"fine_mm", exposure.fineMm},
            {"low_mm", {exposure.lowMm.x, exposure.lowMm.y, exposure.lowMm.z}},
            {"high_mm", {exposure.highMm.x, exposure.highMm.y, exposure.highMm.z}},
            {"axes", axes}};
}

Tone toneFrom(const JsonValue &in) {
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    Tone tone;
    if (const JsonValue inverted = in["inverted"])
        tone.inverted = inverted.boolean();
    if (const JsonValue low = in["low"])
        tone.low = low.number();
    if (const JsonValue high = in["high"])
        tone.high = high.number();
    if (const JsonValue detail = in["detail"])
        tone.detail = detail.number();
    if (const JsonValue latitude = in["latitude"])
        tone.latitude = latitude.number();
    if (const JsonValue exposure = in["exposure"])
        tone.exposure = exposureFrom(exposure);
    return tone;
}

Scene parsed(const JsonValue &in) {
    const JsonValue version = in.at("schema");
    if (version.text() != schema)
        version.refuse(because::isNot(schema));
    Scene scene;
    scene.camera = cameraFrom(in.at("camera"));
    if (const JsonValue window = in["window"]) {
        const auto [low, high] = window.twoNumbers();
        scene.fieldWindow = classify::FieldWindow{low, high};
    }
    scene.look = classify::lookFrom(in);
    scene.shading = shading::shadingFrom(in);
    if (const JsonValue crop = in["crop"])
        scene.crop = cropFrom(crop);
    scene.image = imageFrom(in);
    if (const JsonValue ofDifference = in["of_difference"])
        scene.isOfDifference = ofDifference.boolean();
    if (const JsonValue tolerance = in["tolerance"])
        scene.tolerance = tolerance.number();
    if (const JsonValue plannedFor = in["planned_for"])
        scene.plannedFor = plannedFor.meaning(plannedFors);
    scene.interpolation = interpolationFrom(in);
    if (const JsonValue tone = in["tone"])
        scene.tone = toneFrom(tone);
    return scene;
}

} // namespace

json jsonOf(const Scene &scene) {
    const glm::dquat &q = scene.camera.orientation;
    json out = {{"schema", schema},
                {"camera",
                 {{"orientation", {q.w, q.x, q.y, q.z}},
                  {"pixel_mm", scene.camera.pixelMm},
                  {"size", {scene.camera.width, scene.camera.height}},
                  {"pan_mm", {scene.camera.panMm.x, scene.camera.panMm.y}}}},
                {"reconstruction", wordFor(scene.image.reconstruction, reconstructions)},
                {"roll_off", scene.image.rollOff},
                {"tolerance", scene.tolerance},
                {"tone", {{"inverted", scene.tone.inverted}}}};
    if (scene.image.detail > 0.0) {
        out["detail"] = scene.image.detail;
        out["detail_mm"] = scene.image.detailMm;
    }
    if (scene.isOfDifference)
        out["of_difference"] = true;
    if (scene.plannedFor == PlannedFor::volume)
        out["planned_for"] = wordFor(scene.plannedFor, plannedFors);
    if (scene.fieldWindow)
        out["window"] = {scene.fieldWindow->low, scene.fieldWindow->high};
    out.update(classify::jsonOf(scene.look));
    out.update(shading::jsonOf(scene.shading));
    const auto list = [](const glm::dvec3 &v) { return json{v.x, v.y, v.z}; };
    if (!scene.crop.isWhole())
        out["crop"] = {{"low", list(scene.crop.low)}, {"high", list(scene.crop.high)}};
    if (scene.tone.low)
        out["tone"]["low"] = *scene.tone.low;
    if (scene.tone.high)
        out["tone"]["high"] = *scene.tone.high;
    if (scene.tone.detail)
        out["tone"]["detail"] = *scene.tone.detail;
    if (scene.tone.latitude)
        out["tone"]["latitude"] = *scene.tone.latitude;
    if (scene.tone.exposure)
        out["tone"]["exposure"] = jsonOf(*scene.tone.exposure);
    const Interpolation &fixed = scene.interpolation;
    if (fixed.kernel)
        out["kernel"] = fourier::kernelName(*fixed.kernel);
    if (fixed.padding)
        out["padding"] = *fixed.padding;
    if (fixed.storage)
        out["storage"] = fourier::storageName(*fixed.storage);
    if (fixed.isUniform)
        out["uniform"] = true;
    return out;
}

std::string toJson(const Scene &scene) {
    return jsonOf(scene).dump(2);
}

Scene sceneFrom(const JsonValue &in) {
    Scene scene = parsed(in);
    in.checked([&] { validate(scene); });
    // An orientation of length 1 is not changed: a saved scene gives the same picture to the bit.
    constexpr double rounding = 1e-12;
    if (glm::dquat &q = scene.camera.orientation; std::abs(glm::dot(q, q) - 1.0) > rounding)
        q = glm::normalize(q);
    return scene;
}

Scene sceneFromJson(const std::string &text) {
    json in;
    try {
        in = json::parse(text);
    } catch (const json::exception &error) {
        throw task::Error(task::ErrorCode::usage,
                          because::sceneIsNotValid(files::jsonFault(error)));
    }
    return sceneFrom(JsonValue(in));
}

} // namespace pellucid::scene
