// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/look_options.h"
#include "app/cli/scene_options.h"
#include "app/cli/segment_options.h"
#include "app/cli/spectrum_picture.h"
#include "core/classify/shown_fields.h"
#include "core/preprocess/step_cache.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;

struct Options {
    InputOptions input;
    SceneOptions scene;
    std::string out;
    bool field = false, edges = false, spectrum = false, gzip = false, json = false;
};

// A name alone has the weight 1.
SceneOptions withWeights(SceneOptions scene, bool edges) {
    if (edges)
        scene.classes = {"edges"};
    scene.weightsAreOptional = true;
    return scene;
}

void run(const Options &o, const CLI::App &command, const Context &context) {
    if (o.spectrum) {
        checkSpectrum(o.out, command);
        writeSpectrum(o.out, o.input, withWeights(o.scene, o.edges), command, o.json, context);
        return;
    }
    if (std::filesystem::path(o.out).extension() != ".nrrd")
        throw task::Error(task::ErrorCode::usage,
                          because::inWords("-o: '" + o.out + "' must end in .nrrd"));
    const bool hasSegment = !o.scene.segments.empty();
    if (command.count("--window") > 0 && !o.field && o.scene.classes.empty() && !o.edges &&
        !hasSegment)
        throw task::Error(task::ErrorCode::usage,
                          because::inWords("--window needs --field, --class or --segment"));
    if (!o.scene.segmentations.empty() && !hasSegment)
        throw task::Error(task::ErrorCode::usage,
                          because::inWords("--segmentation needs --segment"));
    if (o.scene.classes.size() > 1)
        throw task::Error(task::ErrorCode::usage,
                          because::inWords("--class: only one class can be written"));
    std::optional<classify::TissueClass> tissue;
    if (command.count("--class") > 0 || o.edges)
        tissue = classNamed(o.edges ? "edges" : o.scene.classes.front());
    std::optional<classify::FieldWindow> window;
    if (command.count("--window") > 0)
        window = parseWindow(o.scene.window);
    const Input input = openInput(o.input, {o.out}, context);
    const volume::Volume &volume = input.loaded.volume;
    const auto encoding = o.gzip ? volume::NrrdEncoding::gzip : volume::NrrdEncoding::raw;
    const auto segments = loadSegments(o.scene.segmentations, {o.out}, volume, context);
    classify::Look shown;
    if (segments)
        showSegments(shown, withWeights(o.scene, false), *segments);
    if (shown.classes.size() > 1)
        throw task::Error(task::ErrorCode::usage,
                          because::inWords("--segment: only one segment can be written"));
    if (!shown.classes.empty())
        tissue = shown.classes.front();
    if (!o.field && !tissue) {
        volume::writeNrrd(o.out, volume, encoding, task::Progress(context.stop));
        return;
    }
    const task::Progress progress(context.stop);
    const auto wanted = window.value_or(classify::defaultFieldWindow(volume));
    preprocess::StepCache steps(0); // no step runs twice
    preprocess::ClassRunner runner(steps, segments);
    const auto field = tissue ? classify::classField(volume, wanted, *tissue, &runner, progress)
                              : classify::densityField(volume, wanted, progress);
    volume::writeNrrd(o.out, field.values.asVolume(), encoding, task::Progress(context.stop));
}

} // namespace

void addVolumeCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("volume", "Write a volume, its field (the values after window "
                                               "and classes), or a slice of the spectrum");
    addInputOptions(*c, o->input);
    addSubtractionOptions(*c, o->input);
    c->add_option("-o,--output", o->out, "File to write: .nrrd; with --spectrum .png or .npy")
        ->required();
    CLI::Option *field =
        c->add_flag("--field", o->field,
                    "Write the field that is projected, from 0 to 1, instead of the values");
    CLI::Option *edges =
        c->add_flag("--edges", o->edges, "Write the Canny edges (the standard class 'edges')")
            ->excludes(field);
    CLI::Option *gzip = c->add_flag("--gzip", o->gzip, "Compress the samples");
    CLI::Option *spectrum =
        c->add_flag(
             "--spectrum", o->spectrum,
             "Write the slice of the spectrum from which a view is computed, in decibels relative "
             "to frequency 0: as grey levels from 0 to -100 dB (.png) or as numbers (.npy)")
            ->excludes(field)
            ->excludes(gzip);
    const auto before = c->get_options();
    addSceneOptions(*c, o->scene);
    for (CLI::Option *option : c->get_options())
        if (std::find(before.begin(), before.end(), option) == before.end() &&
            option->get_name() != "--window" && option->get_name() != "--class" &&
            option->get_name() != "--segmentation" && option->get_name() != "--segment")
            option->needs(spectrum)->group("With --spectrum");
    for (const char *name : shadingOptions)
        c->get_option(name)->group(""); // refused, therefore not offered
    c->get_option("--class")
        ->description("Write the field of a standard class; with --spectrum: "
                      "NAME[=WEIGHT][:#rrggbb], may be repeated")
        ->excludes(field)
        ->excludes(edges);
    c->get_option("--segment")
        ->description("Write the field of a segment; with --spectrum: NAME[=WEIGHT][:#rrggbb], may "
                      "be repeated")
        ->excludes(field)
        ->excludes(edges)
        ->excludes("--class");
    c->add_flag("--json", o->json, "Print a report as one JSON object")->needs(spectrum);
    c->callback([o, c, context] { naming(o->input.path, [&] { run(*o, *c, context); }); });
}

} // namespace pellucid::cli
