// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/spectrum_picture.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"
#include "app/cli/look_options.h"
#include "app/cli/scene_fields.h"
#include "app/cli/segment_options.h"
#include "app/cli/terminal.h"
#include "core/files/image_files.h"
#include "core/prepare/prepared_engine.h"
#include "core/render/spectrum_slice.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

} // namespace

void checkSpectrum(const fs::path &out, const CLI::App &command) {
    if (out.extension() != ".png" && out.extension() != ".npy")
        throw Error(ErrorCode::usage,
                    because::inWords("-o: '" + out.string() +
                                     "' must end in .png or .npy with --spectrum"));
    for (const char *option : shadingOptions)
        if (command.count(option) > 0)
            throw Error(ErrorCode::usage,
                        because::inWords(std::string(option) +
                                         ": --spectrum shows the fields without cue and light"));
}

void writeSpectrum(const fs::path &out, const InputOptions &inputOptions,
                   const SceneOptions &options, const CLI::App &command, bool asJson,
                   const Context &context) {
    const Input input = openInput(inputOptions, {out}, context);
    const volume::Volume &volume = input.loaded.volume;
    const auto preset = presetFor(options);
    const auto segments = loadSegments(options.segmentations, {out}, volume, context);
    scene::Scene scene = sceneFor(options, command, preset, volume, segments.get());
    scene.shading = {}; // may come from a preset or a scene file
    const task::Progress progress(context.stop);
    const classify::FieldWindow window = windowFor(scene, volume);
    const classify::ShownFields fields = fieldsFor(scene, volume, segments, context);
    if (const std::string why = whyEmpty(scene, volume, fields); !why.empty())
        throw Error(ErrorCode::unusable, because::inWords(why));
    const auto prepared = prepare::prepareEngine({.scene = scene,
                                                  .fields = fields,
                                                  .budget = {system::availableMemoryBytes()},
                                                  .pictures = 1},
                                                 progress);
    std::vector<std::string> warnings = englishTexts(volume.notes().warnings);
    const auto warnOf = [&](const std::string &text) {
        warnings.push_back(text);
        warn(text);
    };
    for (const std::string &text : lookWarnings(command, preset, scene, volume))
        warnOf(text);
    if (prepared.isCoarse) // the volume was averaged to fit in memory
        warnOf(prepared.plan.reason.english());
    const int side = std::max({scene.camera.width, scene.camera.height, 2});
    const render::SpectrumSlice slice =
        render::spectrumSlice(prepared.engine->parts(), scene.camera, side, progress);
    if (out.extension() == ".npy")
        files::writeNpy(out, slice.decibels, side, side);
    else
        files::writePng(out, render::greyLevels(slice), side, side);
    if (!asJson)
        return;
    json skipped = json::array();
    for (const auto &s : input.skipped)
        skipped.push_back({{"path", s.path.string()}, {"reason", s.reason.english()}});
    const auto bound = prepare::boundOf(prepared, scene.image);
    const fourier::SpectrumLayout &layout = prepared.plan.spectrum;
    std::puts(jsonText({{"size", {side, side}},
                        {"step_per_mm", slice.stepPerMm},
                        {"limit_per_mm", slice.limitPerMm},
                        {"white_decibels", 0.0},
                        {"black_decibels", render::blackDecibels},
                        {"window", {window.low, window.high}},
                        {"series", input.seriesUid},
                        {"plan",
                         {{"kernel", layout.kernels[0].name()},
                          {"padded", sizeJson(layout.padded)},
                          {"box", sizeJson(layout.box.size())},
                          {"storage", fourier::storageName(layout.storage)},
                          {"predicted_error", bound ? json(bound->relative) : json()},
                          {"reason", prepared.plan.reason.english()}}},
                        {"warnings", warnings},
                        {"skipped", skipped}})
                  .c_str());
}

} // namespace pellucid::cli
