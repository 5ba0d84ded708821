// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/look_options.h"

#include <algorithm>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/common.hpp>

#include "app/cli/input.h"
#include "app/cli/reasons.h"
#include "app/cli/scene_options.h"
#include "app/cli/segment_options.h"
#include "core/classify/region_edits.h"
#include "core/presets/preset_library.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

std::vector<double> weightsFromText(const std::string &text) {
    const auto count = std::size_t(std::count(text.begin(), text.end(), ',')) + 1;
    return parseNumbers("--bezier", text, ',', count);
}

classify::TissueClass classFromText(const std::string &text, const SceneOptions &options) {
    const WeightedName named = parseWeightedName(
        "--class", text, options.weightsAreOptional ? Weight::optional : Weight::required);
    classify::TissueClass tissue = classNamed(named.name);
    // Grey unless a color is named: so is the picture then.
    tissue.color = named.color.value_or(classify::Color{});
    tissue.weight = named.weight;
    return tissue;
}

} // namespace

const classify::TissueClass &classNamed(const std::string &name) {
    std::string names;
    for (const auto *const classes : {&classify::standardClasses(), &classify::differenceClasses()})
        for (const classify::TissueClass &tissue : *classes) {
            if (tissue.name == name)
                return tissue;
            names += (names.empty() ? "" : ", ") + tissue.name;
        }
    throw Error(ErrorCode::usage,
                because::inWords("--class: unknown class '" + name + "': use one of " + names));
}

std::optional<presets::Preset> presetFor(const SceneOptions &options) {
    if (options.preset.empty())
        return std::nullopt;
    const fs::path path(options.preset);
    if (path.extension() == ".json" || path.has_parent_path())
        return presets::readPreset(path);
    return presets::PresetLibrary::ofUser().get(options.preset).preset;
}

void changeLook(classify::Look &look, const SceneOptions &options) {
    if (!options.bezier.empty()) {
        look.transferFunction = {weightsFromText(options.bezier)};
        if (!options.bezierRange.empty()) {
            const auto range = parseNumbers("--bezier-range", options.bezierRange, ',', 2);
            look.transferFunction.low = range[0];
            look.transferFunction.high = range[1];
        }
        look.classes.clear();
    }
    if (!options.classes.empty())
        look.classes.clear();
    for (const std::string &text : options.classes)
        look.classes.push_back(classFromText(text, options));
    classify::validate(look);
}

void addPoints(classify::Look &look, const std::vector<std::string> &points,
               const volume::Lattice &lattice) {
    for (const std::string &text : points) {
        const auto equals = text.rfind('=');
        if (equals == std::string::npos || equals == 0)
            throw Error(ErrorCode::usage,
                        because::inWords("--point: '" + text + "' is not NAME=x,y,z"));
        const auto mm = parseNumbers("--point", text.substr(equals + 1), ',', 3);
        const std::string name = text.substr(0, equals);
        const glm::dvec3 v = glm::round(lattice.voxel({glm::dvec3(mm[0], mm[1], mm[2])}).v);
        const volume::GridSize n = lattice.size();
        if (!(v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0 && v.x < n.i && v.y < n.j && v.z < n.k))
            throw Error(ErrorCode::usage,
                        because::inWords("--point: '" + text + "' is outside the volume"));
        const auto tissue = std::find_if(look.classes.begin(), look.classes.end(),
                                         [&](const auto &one) { return one.name == name; });
        if (tissue == look.classes.end() || !classify::addPoint(*tissue, {{mm[0], mm[1], mm[2]}}))
            throw Error(ErrorCode::usage,
                        because::inWords("--point: no class '" + name + "' takes points"));
    }
    classify::validate(look);
    if (const auto awaiting = classify::awaitingClass(look))
        throw Error(ErrorCode::usage, because::classAwaitsPoints(look.classes[*awaiting].name));
}

void addPointOption(CLI::App &command, std::vector<std::string> &points) {
    command
        .add_option("--point", points,
                    "NAME=x,y,z: a point in patient space (LPS, mm) from which the class NAME "
                    "grows; may be repeated")
        ->allow_extra_args(false);
}

classify::Look lookFor(const SceneOptions &options, const std::optional<presets::Preset> &preset) {
    classify::Look look = preset ? preset->look : classify::Look();
    changeLook(look, options);
    return look;
}

shading::Shading shadingFor(const SceneOptions &o, const CLI::App &command,
                            const std::optional<presets::Preset> &preset,
                            const shading::Shading &former) {
    shading::Shading shading = preset ? preset->shading : former;
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
    if (shading.lights.size() > shading::maxLights)
        throw Error(ErrorCode::usage,
                    because::inWords(
                        fmt::format("--light: at most {} lights are allowed", shading::maxLights)));
    return shading;
}

} // namespace pellucid::cli
