// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/cli/input.h"
#include "core/files/read_text.h"
#include "core/presets/preset_library.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

const std::map<std::string, scene::StandardView> views{
    {"front", scene::StandardView::front}, {"back", scene::StandardView::back},
    {"left", scene::StandardView::left},   {"right", scene::StandardView::right},
    {"top", scene::StandardView::top},     {"bottom", scene::StandardView::bottom}};

const std::map<std::string, scene::Reconstruction> reconstructions{
    {"cubic", scene::Reconstruction::cubic},
    {"linear", scene::Reconstruction::linear},
    {"band-limited", scene::Reconstruction::bandLimited},
    {"spline", scene::Reconstruction::spline}};

scene::Scene readScene(const fs::path &path) {
    if (path.empty())
        throw Error(ErrorCode::usage, because::inWords("--scene: an empty path leads nowhere"));
    const std::string text = files::readText(path, files::mostOfPreset);
    try {
        return scene::sceneFromJson(text);
    } catch (const Error &error) { // of the file, not of the command line
        throw Error(ErrorCode::unusable, error.reason(), path);
    }
}

std::vector<double> weightsFromText(const std::string &text) {
    const auto count = std::size_t(std::count(text.begin(), text.end(), ',')) + 1;
    return parseNumbers("--bezier", text, ',', count);
}

classify::TissueClass classFromText(const std::string &text) {
    const auto equals = text.find('=');
    const auto colon = text.find(':', equals == std::string::npos ? 0 : equals);
    if (equals == std::string::npos)
        throw Error(ErrorCode::usage,
                    because::inWords("--class: '" + text + "' is not NAME=WEIGHT[:#rrggbb]"));
    classify::TissueClass tissue = classNamed(text.substr(0, equals));
    // Grey unless a colour is named: so is the picture then.
    tissue.color = colon == std::string::npos ? classify::Color{}
                                              : classify::colorFromText(text.substr(colon + 1));
    tissue.weight =
        parseNumbers("--class",
                     text.substr(equals + 1, colon == std::string::npos ? std::string::npos
                                                                        : colon - equals - 1),
                     ',', 1)
            .front();
    return tissue;
}

// A curve asked for by name shows the whole volume through it, classes show themselves.
void change(classify::Look &look, const SceneOptions &options) {
    if (!options.bezier.empty()) {
        look.transferFunction.weights = weightsFromText(options.bezier);
        look.classes.clear();
    }
    if (!options.classes.empty())
        look.classes.clear();
    for (const std::string &text : options.classes)
        look.classes.push_back(classFromText(text));
    classify::validate(look);
}

} // namespace

const classify::TissueClass &classNamed(const std::string &name) {
    std::string names;
    for (const classify::TissueClass &tissue : classify::standardClasses()) {
        if (tissue.name == name)
            return tissue;
        names += (names.empty() ? "" : ", ") + tissue.name;
    }
    throw Error(ErrorCode::usage, because::inWords("--class: '" + name + "' is none of " + names));
}

std::optional<presets::Preset> presetFor(const SceneOptions &options) {
    if (options.preset.empty())
        return std::nullopt;
    const fs::path path(options.preset);
    if (path.extension() == ".json" || path.has_parent_path())
        return presets::readPreset(path);
    return presets::PresetLibrary::ofUser().get(options.preset).preset;
}

classify::Look lookFor(const SceneOptions &options) {
    const auto preset = presetFor(options);
    classify::Look look = preset ? preset->look : classify::Look();
    change(look, options);
    return look;
}

shading::Shading shadingFor(const SceneOptions &o, const CLI::App &command,
                            const shading::Shading &former) {
    shading::Shading shading = former;
    if (const auto preset = presetFor(o))
        shading = preset->shading;
    const auto read = [](const char *option, const std::string &text, auto &&fromText) {
        try {
            return fromText(text);
        } catch (const Error &error) {
            throw Error(error.code(),
                        because::inWords(std::string(option) + ": " + error.reason().english()));
        }
    };
    if (command.count("--depth-cue") > 0)
        shading.cue = read("--depth-cue", o.depthCue, shading::cueFromText);
    if (command.count("--ambient") > 0)
        shading.ambient = o.ambient;
    if (!o.lights.empty())
        shading.lights.clear();
    for (const std::string &text : o.lights)
        shading.lights.push_back(read("--light", text, shading::lightFromText));
    if (shading.lights.size() > shading::mostLights)
        throw Error(ErrorCode::usage, because::inWords(fmt::format("--light: more than {} lights",
                                                                   shading::mostLights)));
    return shading;
}

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    const CLI::Validator positive(
        [](std::string &text) {
            char *end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool good =
                end != text.c_str() && *end == '\0' && std::isfinite(value) && value > 0.0;
            return good ? std::string() : "'" + text + "' is not a positive number";
        },
        "", "positive");
    const auto names = [](const auto &map) {
        std::vector<std::string> keys;
        for (const auto &[key, value] : map)
            keys.push_back(key);
        return keys;
    };
    command.add_option("--view", options.view, "Standard view, default front")
        ->check(CLI::IsMember(names(views)));
    command.add_option("--azimuth", options.azimuthDeg,
                       "Degrees about the patient's long axis, added to the view");
    command.add_option("--elevation", options.elevationDeg,
                       "Degrees up from the horizon, added to the view");
    command.add_option("--roll", options.rollDeg,
                       "Degrees about the line of sight, added to the view");
    command.add_option("--orientation", options.orientation,
                       "Rotation [U V W] as a quaternion w,x,y,z");
    command.add_option("--size", options.size,
                       "Image size WxH in pixels; default: holds every view");
    command
        .add_option("--pixel-mm", options.pixelMm,
                    "Pixel size in mm; default: the shortest voxel step")
        ->check(positive);
    command.add_option("--preset", options.preset, "A look of the library, or its file")
        ->check(notEmpty());
    command.add_option("--window", options.window, "The field's window LO,HI in value units");
    command
        .add_option("--bezier", options.bezier,
                    "Weights w0,w1,... of the transfer function, 2 to 16 of 0 to 2")
        ->check(notEmpty());
    command
        .add_option("--class", options.classes,
                    "NAME=WEIGHT[:#rrggbb]: show the classes named, by weight 0 to 2; repeat it")
        ->allow_extra_args(false);
    command
        .add_option("--depth-cue", options.depthCue,
                    "none, linear:S, sine:S (S 0 to 1), or curve:c0,c1,.. from far to near, "
                    "2 to 8 of 0 to 2")
        ->check(notEmpty());
    command
        .add_option("--light", options.lights,
                    "u,v,w[:#rrggbb[:S]]: a light of strength S, 0 to 1, from that direction "
                    "(right, up, toward the "
                    "viewer); repeat it")
        ->allow_extra_args(false);
    command
        .add_option("--light-frame", options.lightFrame,
                    "What the lights follow when the view turns, default viewer")
        ->check(CLI::IsMember({"viewer", "patient"}));
    command.add_option("--ambient", options.ambient, "The ambient light, 0 to 2, default 1")
        ->check(CLI::Range(0.0, shading::largestAmbient));
    command.add_option("--reconstruction", options.reconstruction, "What lies between the samples")
        ->check(CLI::IsMember(names(reconstructions)));
    command
        .add_option("--roll-off", options.rollOff,
                    "Share of the band that is rolled off, default 0.05")
        ->check(CLI::Range(0.0, 1.0));
    CLI::Option *quality =
        command.add_option("--quality", options.quality, "Named tolerance, default standard")
            ->check(CLI::IsMember(names(scene::namedTolerances)));
    command.add_option("--tolerance", options.tolerance, "Largest relative L2 error")
        ->check(positive)
        ->excludes(quality);
    command.add_option("--kernel", options.kernel,
                       "Interpolation kernel; default: the cheapest that keeps the tolerance");
    command
        .add_option("--padding", options.padding, "Padded size over field size, default as needed")
        ->check(CLI::Range(1.0, 4.0));
    command.add_option("--storage", options.storage, "Cells of the spectrum, default as needed")
        ->check(CLI::IsMember({"f16", "f32"}));
    command.add_option("--crop", options.crop,
                       "The part that is shown: low,high of columns, rows and slices, in shares of "
                       "the volume from 0 to 1");
    command.add_option("--scene", options.scene, "Start from a scene saved as JSON");
}

scene::Scene sceneFor(const SceneOptions &o, const CLI::App &command,
                      const volume::Volume &volume) {
    const volume::Lattice &lattice = volume.lattice();
    const auto given = [&](const char *name) { return command.count(name) > 0; };
    scene::Scene scene;
    if (given("--scene")) {
        scene = readScene(o.scene);
    } else {
        // A large volume may have no default image; naming a size or a pixel gives it one.
        if (!given("--size") && !given("--pixel-mm"))
            scene.camera = scene::defaultCamera(lattice);
        scene.camera.orientation = scene::viewOrientation(scene::StandardView::front);
        scene.camera.pixelMm = lattice.shortestStepMm();
    }
    for (const auto &[name, value] : {std::pair{"--azimuth", o.azimuthDeg},
                                      {"--elevation", o.elevationDeg},
                                      {"--roll", o.rollDeg},
                                      {"--roll-off", std::max(o.rollOff, 0.0)}})
        if (!std::isfinite(value))
            throw Error(ErrorCode::usage,
                        because::inWords(std::string(name) + ": the number must be finite"));
    if (given("--orientation")) {
        if (given("--view") || given("--azimuth") || given("--elevation") || given("--roll"))
            throw Error(ErrorCode::usage,
                        because::inWords(
                            "--orientation excludes --view, --azimuth, --elevation and --roll"));
        const auto q = parseNumbers("--orientation", o.orientation, ',', 4);
        // Scaled first, so that huge and tiny quaternions can be normalised too.
        const double largest =
            std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3]), 1e-300});
        const glm::dquat rotation(q[0] / largest, q[1] / largest, q[2] / largest, q[3] / largest);
        if (!(glm::length(rotation) > 0.0))
            throw Error(ErrorCode::usage,
                        because::inWords("--orientation: the quaternion must not be zero"));
        scene.camera.orientation = glm::normalize(rotation);
    } else if (o.scene.empty() || given("--view") || given("--azimuth") || given("--elevation") ||
               given("--roll")) {
        scene.camera.orientation =
            scene::viewOrientation(o.view.empty() ? scene::StandardView::front : views.at(o.view),
                                   {o.azimuthDeg, o.elevationDeg, o.rollDeg});
    }
    if (given("--pixel-mm")) {
        scene.camera.pixelMm = o.pixelMm;
        if (o.scene.empty() && !given("--size")) { // the whole volume at that pixel
            const double side = 2.0 * lattice.radiusMm() / o.pixelMm;
            if (!(o.pixelMm > 0.0) || side > scene::largestImageSize)
                throw Error(
                    ErrorCode::usage,
                    because::inWords(fmt::format(
                        "--pixel-mm: an image of the whole volume would have {:.0f} pixels a side",
                        side)));
            const int n = int(std::ceil(side - 1e-6));
            scene.camera.width = scene.camera.height = std::max(2, n + n % 2);
        }
    }
    if (given("--size")) {
        if (o.size.find_first_not_of("0123456789x") != std::string::npos)
            throw Error(ErrorCode::usage,
                        because::inWords("--size: '" + o.size +
                                         "' is not whole numbers with 'x' between them"));
        const auto n = parseNumbers("--size", o.size, 'x', 2);
        if (n[0] != std::round(n[0]) || n[1] != std::round(n[1]) || std::min(n[0], n[1]) < 1 ||
            std::max(n[0], n[1]) > scene::largestImageSize)
            throw Error(ErrorCode::usage, because::inWords(fmt::format(
                                              "--size: '{}' is not WIDTHxHEIGHT of 1 to {} pixels",
                                              o.size, scene::largestImageSize)));
        scene.camera.width = int(n[0]);
        scene.camera.height = int(n[1]);
    }
    const auto preset = presetFor(o);
    if (preset)
        scene.fieldWindow = preset->window;
    if (given("--window"))
        scene.fieldWindow = parseWindow(o.window);
    if (preset)
        scene.look = presets::lookFor(
            *preset, scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)));
    change(scene.look, o);
    scene.shading = shadingFor(o, command, scene.shading);
    if (given("--light-frame")) {
        if (o.lights.empty())
            throw Error(ErrorCode::usage,
                        because::inWords("--light-frame says how a --light is meant"));
        // Directions are given as seen in the scene's view.
        const glm::dmat3 axes = scene.camera.axes();
        for (shading::Light &light : scene.shading.lights)
            if (o.lightFrame == "patient") {
                light.direction = axes * glm::normalize(light.direction);
                light.frame = shading::LightFrame::patient;
            }
    }
    if (given("--crop")) {
        const auto n = parseNumbers("--crop", o.crop, ',', 6);
        scene.crop = {{n[0], n[2], n[4]}, {n[1], n[3], n[5]}};
    }
    if (given("--reconstruction"))
        scene.image.reconstruction = reconstructions.at(o.reconstruction);
    if (given("--roll-off"))
        scene.image.rollOff = o.rollOff;
    if (given("--quality"))
        for (const auto &[name, tolerance] : scene::namedTolerances)
            if (o.quality == name)
                scene.tolerance = tolerance;
    if (given("--tolerance"))
        scene.tolerance = o.tolerance;
    if (given("--kernel"))
        scene.interpolation.kernel = fourier::kernelFromName(o.kernel);
    if (given("--padding"))
        scene.interpolation.padding = o.padding;
    if (given("--storage"))
        scene.interpolation.storage = fourier::storageFromName(o.storage);
    scene::validate(scene);
    return scene;
}

} // namespace pellucid::cli
