// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "core/presets/preset_library.h"
#include "core/presets/slicer_preset.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using presets::PresetEntry;
using presets::PresetLibrary;

struct Options {
    std::string name, path, out;
    int points = 8;
    bool replace = false;
};

PresetLibrary openLibrary() {
    PresetLibrary library = PresetLibrary::ofUser();
    for (const auto &skipped : library.skipped())
        warn(skipped.path.string() + ": " + skipped.reason.english());
    return library;
}

void list() {
    const PresetLibrary library = openLibrary();
    for (const PresetEntry &entry : library.entries()) {
        const auto &preset = entry.preset;
        std::puts(printable(fmt::format("{:<28}  {:<4}  {:<8}  {}", preset.name,
                                        preset.modality.empty() ? "any" : preset.modality,
                                        entry.isBuiltIn() ? "built in" : "own", preset.notes))
                      .c_str());
    }
}

void validate(const Options &o) {
    if (presets::isSlicerPreset(o.path))
        throw task::Error(
            task::ErrorCode::usage,
            because::inWords("is a volume property of 3D Slicer; 'preset import' converts it"),
            o.path);
    const auto preset = presets::readPreset(o.path);
    std::puts(printable(fmt::format("{}: a preset named '{}'", o.path, preset.name)).c_str());
}

void exportTo(const Options &o) {
    presets::writePreset(o.out, openLibrary().get(o.name).preset);
}

void import(const Options &o) {
    PresetLibrary library = openLibrary();
    presets::Preset preset;
    std::string fit;
    if (presets::isSlicerPreset(o.path)) {
        auto imported = presets::importSlicerPreset(o.path, o.points);
        preset = std::move(imported.preset);
        fit = fmt::format("; largest opacity error {:.2g}", imported.largestError);
        constexpr double visible = 0.1;
        if (imported.largestError > visible)
            warn(fmt::format(
                "the opacity changes too steeply for one curve of {} points; use classes "
                "for steps",
                o.points));
    } else {
        preset = presets::readPreset(o.path);
    }
    if (!o.name.empty())
        preset.name = o.name;
    if (const PresetEntry *former = library.find(preset.name);
        former != nullptr && !former->isBuiltIn() && !o.replace)
        throw task::Error(
            task::ErrorCode::usage,
            because::inWords("preset '" + preset.name +
                             "' already exists: use --replace, or --name for a different name"));
    library.save(preset);
    std::puts(printable(fmt::format("imported '{}'{}", preset.name, fit)).c_str());
}

} // namespace

void addPresetCommand(CLI::App &app, const Context &) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("preset", "List, show, validate, export and import presets");
    c->require_subcommand(1);
    c->add_subcommand("list", "List the presets, one per line")->callback([] { list(); });
    CLI::App *show = c->add_subcommand("show", "Print a preset as JSON");
    show->add_option("NAME", o->name, "Name of the preset")->required();
    show->callback([o] {
        std::puts(escapedControls(presets::toJson(openLibrary().get(o->name).preset)).c_str());
    });
    CLI::App *check = c->add_subcommand("validate", "Check a preset file");
    check->add_option("FILE", o->path, "Preset file")->required();
    check->callback([o] { validate(*o); });
    CLI::App *out = c->add_subcommand("export", "Write a preset to a file");
    out->add_option("NAME", o->name, "Name of the preset")->required();
    out->add_option("-o,--output", o->out, "File to write")->required();
    out->callback([o] { exportTo(*o); });
    CLI::App *in = c->add_subcommand(
        "import", "Add a preset file, or a volume property of 3D Slicer, to the library");
    in->add_option("FILE", o->path, "Preset file, or a .vp or .vp.json file of 3D Slicer")
        ->required();
    in->add_option("--name", o->name,
                   "Name in the library; default: the name of the preset or its file");
    in->add_option("--points", o->points,
                   "Number of control points fitted to the opacity of 3D Slicer; default 8")
        ->check(CLI::Range(2, 16));
    in->add_flag("--replace", o->replace, "Replace your preset of the same name");
    in->callback([o] { import(*o); });
}

} // namespace pellucid::cli
