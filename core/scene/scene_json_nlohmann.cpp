// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/classify/look_json_nlohmann.h"
#include "core/files/json_fields_nlohmann.h"
#include "core/scene/reasons.h"
#include "core/scene/scene_json_nlohmann.h"
#include "core/shading/shading_json_nlohmann.h"
#include "core/task/error.h"

namespace pellucid::fourier {

static void readFrom(const files::JsonValue &in, KernelChoice &kernel) {
    const std::string name = in.text();
    kernel = in.checked([&] { return kernelFromName(name); });
}
static nlohmann::json jsonOf(const KernelChoice &kernel) {
    return kernelName(kernel);
}

static void readFrom(const files::JsonValue &in, Storage &storage) {
    const std::string name = in.text();
    storage = in.checked([&] { return storageFromName(name); });
}
static nlohmann::json jsonOf(const Storage &storage) {
    return storageName(storage);
}

} // namespace pellucid::fourier

namespace pellucid::classify {

static void fields(files::JsonFields &io, CropBox &crop) {
    io.required("low", crop.low);
    io.required("high", crop.high);
}

} // namespace pellucid::classify

namespace pellucid::scene {

namespace because = task::because;
using files::JsonFields;
using files::JsonValue;
using files::JsonWords;
using nlohmann::json;

static constexpr JsonWords<Reconstruction, 4> reconstructions{
    {{"cubic", Reconstruction::cubic},
     {"linear", Reconstruction::linear},
     {"band-limited", Reconstruction::bandLimited},
     {"spline", Reconstruction::spline}}};
static const JsonWords<Reconstruction, 4> &jsonWords(Reconstruction) {
    return reconstructions;
}

static constexpr JsonWords<PlannedFor, 2> plannedFors{
    {{"picture", PlannedFor::picture}, {"volume", PlannedFor::volume}}};
static const JsonWords<PlannedFor, 2> &jsonWords(PlannedFor) {
    return plannedFors;
}

static void fields(JsonFields &io, Camera &camera) {
    io.required("orientation", camera.orientation);
    io.required("pixel_mm", camera.pixelMm);
    std::array<int, 2> size{camera.width, camera.height};
    io.required("size", size);
    camera.width = size[0];
    camera.height = size[1];
    io.known("pan_mm", camera.panMm);
}

static void fields(JsonFields &io, ImageDefinition &image) {
    io.known("reconstruction", image.reconstruction);
    io.known("roll_off", image.rollOff);
    io.unusual("detail", image.detail);
    io.unusual("detail_mm", image.detailMm, ImageDefinition().detailMm);
}

static void fields(JsonFields &io, Interpolation &fixed) {
    io.unusual("kernel", fixed.kernel);
    io.unusual("padding", fixed.padding);
    io.unusual("storage", fixed.storage);
    io.unusual("uniform", fixed.isUniform);
}

static void fields(JsonFields &io, Exposure::Axis &axis) {
    io.required("air", axis.air);
    io.required("dark", axis.dark);
    io.required("bright", axis.bright);
    io.required("low", axis.low);
    io.required("high", axis.high);
    io.required("exponent", axis.exponent);
}

static void fields(JsonFields &io, Exposure &exposure) {
    io.required("detail", exposure.detail);
    io.required("latitude", exposure.latitude);
    io.required("fine_mm", exposure.fineMm);
    io.required("low_mm", exposure.lowMm);
    io.required("high_mm", exposure.highMm);
    io.required("axes", exposure.axes);
}

static void fields(JsonFields &io, Tone &tone) {
    io.known("inverted", tone.inverted);
    io.unusual("low", tone.low);
    io.unusual("high", tone.high);
    io.unusual("detail", tone.detail);
    io.unusual("latitude", tone.latitude);
    io.unusual("exposure", tone.exposure);
}

static void fields(JsonFields &io, Scene &scene) {
    io.schema("pellucid-scene/3");
    io.required("camera", scene.camera);
    io.unusual("window", scene.fieldWindow);
    fields(io, scene.look);
    fields(io, scene.shading);
    io.unusual("crop", scene.crop);
    fields(io, scene.image);
    io.unusual("of_difference", scene.isOfDifference);
    io.known("tolerance", scene.tolerance);
    io.unusual("planned_for", scene.plannedFor);
    fields(io, scene.interpolation);
    io.known("tone", scene.tone);
}

json jsonOf(const Scene &scene) {
    return JsonFields::written(scene);
}

std::string toJson(const Scene &scene) {
    return jsonOf(scene).dump(2);
}

Scene sceneFrom(const JsonValue &in) {
    Scene scene;
    JsonFields::read(in, scene);
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
