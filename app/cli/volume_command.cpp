// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/scene_options.h"
#include "core/classify/shown_fields.h"
#include "core/preprocess/step_cache.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

struct Options {
    InputOptions input;
    std::string out, window, tissue;
    bool field = false, edges = false, gzip = false;
};

void run(const Options &o, const CLI::App &command, const Context &context) {
    if (std::filesystem::path(o.out).extension() != ".nrrd")
        throw task::Error(task::ErrorCode::usage, "-o: '" + o.out + "' must end in .nrrd");
    if (command.count("--window") > 0 && !o.field && o.tissue.empty() && !o.edges)
        throw task::Error(task::ErrorCode::usage, "--window needs --field or --class");
    std::optional<classify::TissueClass> tissue;
    if (command.count("--class") > 0 || o.edges)
        tissue = classNamed(o.edges ? "edges" : o.tissue);
    std::optional<classify::FieldWindow> window;
    if (command.count("--window") > 0)
        window = parseWindow(o.window);
    const Input input = openInput(o.input, {o.out}, context);
    const volume::Volume &volume = input.loaded.volume;
    const auto encoding = o.gzip ? volume::NrrdEncoding::gzip : volume::NrrdEncoding::raw;
    if (!o.field && !tissue) {
        volume::writeNrrd(o.out, volume, encoding, task::Progress(context.stop));
        return;
    }
    const task::Progress progress(context.stop);
    const auto wanted = window.value_or(classify::defaultFieldWindow(volume));
    preprocess::StepCache steps(0); // nothing is asked for twice
    const auto field = tissue ? classify::classField(volume, wanted, *tissue, &steps, progress)
                              : classify::densityField(volume, wanted, progress);
    volume::writeNrrd(o.out, field.values, encoding, task::Progress(context.stop));
}

} // namespace

void addVolumeCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c =
        app.add_subcommand("volume", "Write a volume, or the field that is projected, as NRRD");
    addInputOptions(*c, o->input);
    c->add_option("-o,--output", o->out, "The NRRD file")->required();
    CLI::Option *field =
        c->add_flag("--field", o->field, "Write the field f in 0..1 instead of the values");
    CLI::Option *tissue = c->add_option("--class", o->tissue,
                                        "Write the field of a standard class, as --field otherwise")
                              ->excludes(field);
    c->add_flag("--edges", o->edges, "Write the Canny edges, the standard class 'edges'")
        ->excludes(field)
        ->excludes(tissue);
    c->add_option("--window", o->window, "The field's window LO,HI in value units");
    c->add_flag("--gzip", o->gzip, "Compress the samples");
    c->callback([o, c, context] { naming(o->input.path, [&] { run(*o, *c, context); }); });
}

} // namespace pellucid::cli
