// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/terminal.h"
#include "core/batch/recipe.h"
#include "core/files/reasons.h"
#include "core/files/video_file.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace because = task::because;

void addRecipeCommand(CLI::App &app, const Context &) {
    auto file = std::make_shared<std::string>();
    CLI::App *c = app.add_subcommand("recipe", "Check and explain recipes for 'batch'");
    c->require_subcommand(1);
    CLI::App *check = c->add_subcommand("check", "Check a recipe; if it cannot be used, report "
                                                 "the line");
    check->add_option("RECIPE", *file, "The recipe, a JSON file")->required()->check(notEmpty());
    check->callback([file] {
        const batch::Recipe recipe = batch::readRecipe(*file);
        for (const batch::Output &output : recipe.outputs)
            if (output.format == batch::Format::video && !files::VideoFile::isAvailable())
                warn(output.name + ": " + task::Reason(because::videosNeedFfmpeg).english());
        std::puts(printable(*file + " is a recipe").c_str());
    });
    CLI::App *explain = c->add_subcommand(
        "explain",
        "Describe which series a recipe chooses and what it renders, one line per output");
    explain->add_option("RECIPE", *file, "The recipe, a JSON file")->required()->check(notEmpty());
    explain->callback([file] {
        for (const std::string &line : batch::explained(batch::readRecipe(*file)))
            std::puts(printable(line).c_str());
    });
}

} // namespace pellucid::cli
