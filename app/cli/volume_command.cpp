// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/scene_options.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

struct Options {
    std::string path, out, series, window, tissue;
    bool field = false, gzip = false;
};

void run(const Options &o, const CLI::App &command, const Context &context) {
    if (std::filesystem::path(o.out).extension() != ".nrrd")
        throw task::Error(task::ErrorCode::usage, "-o: '" + o.out + "' must end in .nrrd");
    if (command.count("--window") > 0 && !o.field && o.tissue.empty())
        throw task::Error(task::ErrorCode::usage, "--window needs --field or --class");
    const classify::TissueClass *const tissue = o.tissue.empty() ? nullptr : &classNamed(o.tissue);
    std::optional<classify::FieldWindow> window;
    if (command.count("--window") > 0)
        window = parseWindow(o.window);
    const Input input = openInput(o.path, o.series, context);
    const volume::Volume &volume = input.loaded.volume;
    const auto encoding = o.gzip ? volume::NrrdEncoding::gzip : volume::NrrdEncoding::raw;
    if (!o.field && tissue == nullptr) {
        volume::writeNrrd(o.out, volume, encoding, task::Progress(context.stop));
        return;
    }
    const task::Progress progress(context.stop);
    const auto wanted = window.value_or(classify::defaultFieldWindow(volume));
    const auto density = classify::densityField(volume, wanted, progress.part(0.0, 0.4));
    const auto field =
        tissue == nullptr ? density
                          : classify::classField(volume, density, *tissue, progress.part(0.4, 1.0));
    volume::writeNrrd(o.out, field.values, encoding, task::Progress(context.stop));
}

} // namespace

void addVolumeCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c =
        app.add_subcommand("volume", "Write a volume, or the field that is projected, as NRRD");
    c->add_option("PATH", o->path, "A file, a folder, a DICOMDIR or an NRRD file")->required();
    c->add_option("-o,--output", o->out, "The NRRD file")->required();
    c->add_option("--series", o->series,
                  "Series number or UID; default: the volume with most voxels");
    CLI::Option *field =
        c->add_flag("--field", o->field, "Write the field f in 0..1 instead of the values");
    c->add_option("--class", o->tissue, "Write the field of a standard class, as --field otherwise")
        ->excludes(field);
    c->add_option("--window", o->window, "The field's window LO,HI in value units");
    c->add_flag("--gzip", o->gzip, "Compress the samples");
    c->callback([o, c, context] { run(*o, *c, context); });
}

} // namespace pellucid::cli
